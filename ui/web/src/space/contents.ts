// What the view of the shapes holds, made from its declaration in core/wire by test/shape_types.mjs.

/// The key `space`: what all shapes stand in. Lengths of shapes are whole centimetres from the origin.
export interface SpaceContent {
  t: "space";
  origin: [number, number, number]; ///< The origin, in metres of the scene.
  true_north?: number; ///< Direction of true north, in degrees clockwise from the y axis.
  ground?: number; ///< Height of the ground where no terrain is known.
  is_coarse?: boolean; ///< On where there are so many volumes that they are shown as upright bodies.
  left_out?: number; ///< How many things are left out because there are too many.
}

/// A volume: its cell as polygons, and the ball that they are wrapped onto.
export interface CellContent {
  t: "cell";
  ball: number[]; ///< Centre and radius of the ball: x, y, z, r.
  points: number[]; ///< Corners, from the ball's centre: x, y, z, and so on.
  faces: number[]; ///< For each face the number of its corners, and its corners, counter-clockwise from outside.
  parts: number[]; ///< For each part the number of its faces and of its seams, and the points, from the ball's centre, that its corners move towards: one for all, and one for each seam.
  seams?: number[]; ///< For each corner the seams it lies on, as bits; missing where there are none.
  bottom?: number; ///< Height of its lowest point.
  storey?: number; ///< Height of a storey; 0 where there are none.
}

/// A volume as an upright body over its outline.
export interface PrismContent {
  t: "prism";
  ring: number[]; ///< The outline, counter-clockwise: x, y, and so on.
  low?: number; ///< Height of its underside.
  high?: number; ///< Height of its top.
}

/// A body as triangles: a building, or a volume without a ball.
export interface SurfaceContent {
  t: "surface";
  points: number[]; ///< Corners: x, y, z, and so on.
  triangles: number[]; ///< Three corners each, counter-clockwise from outside.
  bottom?: number; ///< Height of its lowest point.
  storey?: number; ///< Height of a storey; 0 where there are none.
}

/// A street, or the outlines of a plot or a boundary.
export interface LinesContent {
  t: "lines";
  points: number[]; ///< Points of all lines: x, y, z, and so on.
  counts: number[]; ///< How many points each line has.
  is_closed?: boolean; ///< On where each line ends where it begins.
  width?: number; ///< Width of a street.
}

/// The ground as heights on a grid.
export interface TerrainContent {
  t: "terrain";
  grid: number[]; ///< x and y of the first point, the distance of neighbouring points, and how many stand in a row from west to east.
  heights: number[]; ///< Heights, row by row from south to north; -1000000 where none is known.
}

export type ShapeContent = SpaceContent | CellContent | PrismContent | SurfaceContent | LinesContent | TerrainContent;

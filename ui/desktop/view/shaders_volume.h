// Shader texts that divide coarse cells, wrap them onto their balls, and paint them as buildings.
#pragma once

namespace bl::desktop::shaders {

inline constexpr const char* kVersion = "#version 330 core\n";

// The formula of core/geometry/tessellate: a point of the coarse triangle by its two weights, then along the line to the wrap's
// centre until it lies on the ball. Lengths are relative to the ball's centre, so that floats are as fine as the cell is small.
// Records: (ball's centre, radius), (colour, flags), (bottom, storey height, first corner, number).
inline constexpr const char* kDivide = R"(
uniform samplerBuffer corners;
uniform samplerBuffer records;
layout(location = 0) in vec2 weights;
layout(location = 1) in uvec4 triangle;

struct Divided { vec3 flat_place, place, normal; float centre_weight; vec4 ball; bool has_rim; };

vec3 wrapped(vec3 place, float radius, vec3 inside) {
  float squared = radius * radius;
  if (dot(place, place) <= squared) return place;
  float rest = max(0.0, squared - dot(inside, inside));
  vec3 ray = place - inside;
  float a = dot(ray, ray), b = dot(ray, inside);
  float root = sqrt(b * b + a * rest);
  float t = b > 0.0 ? rest / (b + root) : (root - b) / a;
  return inside + min(1.0, t) * ray;
}

Divided divided() {
  Divided d;
  int volume = int(triangle.w);
  d.ball = texelFetch(records, 3 * volume);
  int first = int(texelFetch(records, 3 * volume + 2).z);
  vec4 c = texelFetch(corners, first + int(triangle.x));
  vec4 a = texelFetch(corners, first + int(triangle.y));
  vec4 b = texelFetch(corners, first + int(triangle.z));
  d.flat_place = c.xyz + weights.x * (a.xyz - c.xyz) + weights.y * (b.xyz - c.xyz);
  d.centre_weight = 1.0 - weights.x - weights.y;
  d.has_rim = fract(c.w) < 0.25;
  // The face's centre lies on no seam: its fourth number says instead where its part's wrap has its centre.
  int seams = d.centre_weight > 1e-6 ? 0 : 0xffffff;
  if (weights.x > 1e-6) seams &= int(a.w);
  if (weights.y > 1e-6) seams &= int(b.w);
  int centre = first + int(c.w);
  for (int s = 0; s < 23 && seams != 0; ++s)
    if (((seams >> s) & 1) != 0) {
      centre += 1 + s;
      break;
    }
  d.place = wrapped(d.flat_place, d.ball.w, texelFetch(corners, centre).xyz);
  vec3 across = cross(a.xyz - c.xyz, b.xyz - c.xyz);
  float size = length(across);
  d.normal = size > 0.0 ? across / size : vec3(0.0, 0.0, 1.0);
  return d;
}
)";

inline constexpr const char* kCaptureVertex = R"(
out vec3 captured;
void main() {
  Divided d = divided();
  captured = d.place;
  gl_Position = vec4(d.place, 1.0);
}
)";

// For shadows and heights: the place alone.
inline constexpr const char* kShadowVertex = R"(
uniform mat4 matrix;
out vec3 world;
void main() {
  Divided d = divided();
  world = d.ball.xyz + d.place;
  gl_Position = matrix * vec4(world, 1.0);
}
)";

inline constexpr const char* kShadowFragment = R"(
uniform vec4 section;
in vec3 world;
void main() { if (dot(section.xyz, world) > section.w) discard; }
)";

// What stands where: the highest point above a place, and how near to the ground something is; kept by the largest of each.
inline constexpr const char* kHeightFragment = R"(
uniform vec4 section;
uniform vec2 heights;
in vec3 world;
layout(location = 0) out vec2 found;
void main() {
  if (dot(section.xyz, world) > section.w) discard;
  float above = world.z - heights.x;
  found = vec2(clamp(above / heights.y, 0.0, 1.0), exp(-max(above, 0.0) / (0.12 * heights.y)));
}
)";

inline constexpr const char* kVolumeVertex = R"(
uniform mat4 matrix;
uniform float half_height, pixel;
uniform vec3 eye, looking;
uniform float is_parallel;
out vec3 world, flat_place;
out float centre_weight;
flat out vec3 facet_normal;
flat out int number;
flat out float fineness;

// How much of its lines a volume carries, from 0 to 1: one of a few pixels would be nothing but lines. The matrix's second row is
// as long as a metre is high in the picture, before the division by the depth.
float fineness_of(vec4 ball) {
  float row = length(vec3(matrix[0].y, matrix[1].y, matrix[2].y));
  float depth = max((matrix * vec4(ball.xyz, 1.0)).w, 1e-6);
  return smoothstep(2.5, 22.0, ball.w * row * half_height / depth / pixel);
}

void main() {
  Divided d = divided();
  fineness = fineness_of(d.ball);
  world = d.ball.xyz + d.place;
  flat_place = d.flat_place;
  centre_weight = d.has_rim ? d.centre_weight : 1.0;
  facet_normal = d.normal;
  number = int(triangle.w);
  gl_Position = matrix * vec4(world, 1.0);
  // Where bodies stand on each other, the floor of the upper one lies in the roof below: what looks away stays behind.
  if (dot(d.normal, is_parallel > 0.5 ? -looking : eye - world) < 0.0) gl_Position.z += 1e-4 * gl_Position.w;
}
)";

// Daylight: a sun with soft shadows, a sky, and less of it low between neighbours.
inline constexpr const char* kLight = R"(
uniform vec3 sun;
uniform mat4 sun_matrix, map_matrix;
uniform sampler2DShadow shadow_map;
uniform sampler2D height_map;
uniform vec2 heights;
uniform float shadow_strength, shadow_texel, light_gain;

float sunlight(vec3 place, vec3 normal) {
  if (shadow_strength <= 0.0) return 1.0;
  vec4 s = sun_matrix * vec4(place + heights.y * 0.012 * normal, 1.0);
  vec3 at = 0.5 * s.xyz / s.w + 0.5;
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  at.z -= 0.0015;
  float lit = 0.0;
  for (int i = -1; i <= 1; i += 2)
    for (int j = -1; j <= 1; j += 2) lit += texture(shadow_map, vec3(at.xy + 0.8 * shadow_texel * vec2(i, j), at.z));
  return mix(1.0, 0.25 * lit, shadow_strength);
}

vec2 surroundings(vec3 place) {
  vec4 at = map_matrix * vec4(place, 1.0);
  return texture(height_map, 0.5 * at.xy + 0.5).xy;
}

vec3 lit(vec3 colour, vec3 place, vec3 normal) {
  float direct = max(0.0, dot(normal, sun));
  if (direct > 0.0) direct *= sunlight(place, normal);
  float open = 1.0;
  if (shadow_strength > 0.0) {
    float around = surroundings(place + 0.05 * heights.y * vec3(normal.xy, 0.0)).x * heights.y;
    float sunk = clamp((around - (place.z - heights.x)) / (0.55 * heights.y), 0.0, 1.0);
    open = 1.0 - 0.5 * sunk * (1.0 - max(normal.z, 0.0));
  }
  vec3 sky = mix(vec3(0.40, 0.385, 0.37), vec3(0.62, 0.65, 0.70), 0.5 + 0.5 * normal.z) * open;
  vec3 light = sky + direct * vec3(0.66, 0.63, 0.57);
  return colour * light * light_gain;
}
)";

// Windows in modules between sill and head of each storey: glass with frames and reveals, and mullions between modules. A window
// that is small in the picture fades into the mean of glass and wall. Texels of a façade: where north lies, then for each of the
// eight orientations the window's width, the module, sill and head.
inline constexpr const char* kFacade = R"(
uniform samplerBuffer facades;

float scatter(vec2 cell) {
  uvec2 q = uvec2(ivec2(cell)) * uvec2(1597334673u, 3812015801u);
  uint n = (q.x ^ q.y) * 1597334673u;
  return float(n >> 8) * (1.0 / 16777216.0);
}
// How much of a pixel of that size around `at` lies in a strip, both as shares of its period.
float covered(float at, float half_width, float size) {
  return clamp((half_width - abs(at)) / max(size, 1e-6) + 0.5, 0.0, 1.0);
}

vec3 facade_colour(vec3 wall, int number, vec3 place, vec3 ball, bool is_round, float radius, vec3 normal, vec2 storey) {
  vec2 outward = normal.xy / max(length(normal.xy), 1e-4);
  vec4 north = texelFetch(facades, 9 * number);
  vec2 turned = vec2(outward.x * north.x - outward.y * north.y, outward.y * north.x + outward.x * north.y);
  float bearing = atan(turned.x, turned.y);
  int sector = int(floor(bearing / 0.785398163 + 0.5 + 1e-4) + 8.0) & 7;
  vec4 side = texelFetch(facades, 9 * number + 1 + sector);
  // Along the façade: straight on a flat face, around the axis of the ball on a round one.
  float around = is_round ? atan(outward.y, outward.x) * radius : dot(place.xy - ball.xy, vec2(-outward.y, outward.x));
  // The ball's own height, not that of the triangles that stand for it: windows stay level.
  float height = (is_round ? ball.z + normal.z * radius : place.z) - storey.x;
  float modules = max(side.y, 0.05);
  if (is_round) modules = 6.28318531 * radius / max(1.0, floor(6.28318531 * radius / modules + 0.5));
  vec2 at = vec2(around / modules + 0.5, height / storey.y);
  // Derivatives without the seam of the angle.
  vec2 size = max(fwidth(at), vec2(1e-6));
  size.x = min(size.x, fwidth(fract(at.x + 0.5)));
  vec2 cell = floor(at), in_cell = fract(at);
  vec2 middle = vec2(0.5, 0.5 * (side.z + side.w) / storey.y);
  vec2 half_size = vec2(0.5 * side.x, max(0.0, 0.5 * (side.w - side.z) / storey.y));
  if (half_size.x <= 0.0 || half_size.y <= 0.0 || height < 0.0) return wall;
  vec2 off = in_cell - middle;
  float glass = covered(off.x, half_size.x, size.x) * covered(off.y, half_size.y, size.y);
  vec2 frame = vec2(0.09 / modules, 0.09 / storey.y);
  vec2 pane = max(half_size - frame, vec2(0.0));
  float clear = covered(off.x, pane.x, size.x) * covered(off.y, pane.y, size.y);
  // What is too small to be told apart is the mean of itself.
  float room = smoothstep(0.75, 0.3, max(size.x, 1.4 * size.y)), mean = 4.0 * half_size.x * half_size.y;
  float chance = scatter(cell + 4096.0);
  vec3 sky = mix(vec3(0.20, 0.27, 0.34), vec3(0.52, 0.63, 0.72), smoothstep(-0.9, 0.9, off.y / half_size.y) * 0.55 + 0.45 * chance * chance);
  vec3 dark = vec3(0.10, 0.13, 0.17);
  // The reveal's shade lies under the head, deeper where the sun stands high.
  float reveal = smoothstep(0.10 / storey.y + size.y, 0.0, half_size.y - off.y - frame.y);
  vec3 pane_colour = mix(mix(dark, sky, 0.72), dark * 0.6, 0.6 * reveal);
  vec3 frame_colour = wall * 0.55;
  vec3 sharp = mix(wall, mix(frame_colour, pane_colour, clear / max(glass, 1e-4)), glass);
  // Joints between modules and a sill's edge give the wall its grain.
  float joint = covered(abs(in_cell.x - 0.5) - 0.5, 0.02 / modules + 0.25 * size.x, size.x);
  sharp = mix(sharp, sharp * 0.82, joint * (1.0 - glass));
  float ledge = covered(off.y + half_size.y + 0.05 / storey.y, 0.05 / storey.y, size.y) * covered(off.x, half_size.x, size.x);
  sharp = mix(sharp, min(vec3(1.0), wall * 1.18), 0.8 * ledge * (1.0 - glass));
  vec3 blurred = mix(wall, mix(dark, vec3(0.40, 0.49, 0.57), 0.6), 0.85 * mean);
  return mix(blurred, sharp, room);
}
)";

inline constexpr const char* kVolumeFragment = R"(
uniform samplerBuffer records;
uniform vec4 edge_colour, chosen_colour, hovered_colour, cut_colour, section, ground_colour;
uniform float pixel, with_edges, with_storeys;
#ifdef WITH_SECTION
uniform mat4 matrix;
uniform vec3 eye, looking;
uniform float is_parallel, hatch;
#endif
in vec3 world, flat_place;
in float centre_weight;
flat in vec3 facet_normal;
flat in int number;
flat in float fineness;
layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

vec3 to_linear(vec3 c) { return c * c; }
vec3 to_screen(vec3 c) { return sqrt(clamp(c, 0.0, 1.0)); }
float line(float distance, float width) { return 1.0 - smoothstep(width - 0.5, width + 0.6, distance); }

void main() {
  vec4 ball = texelFetch(records, 3 * number);
  vec4 paint = texelFetch(records, 3 * number + 1);
  vec4 storey = texelFetch(records, 3 * number + 2);
  int flags = int(paint.w);
  label = uint(32 * (number + 1) + 4 * int(7.0 * fineness + 0.5) + (flags & 3));
  float reach = length(flat_place);
  bool is_round = reach > ball.w;
  vec3 normal = is_round ? normalize(world - ball.xyz) : facet_normal;
  vec3 own = paint.rgb;
  float faint = (flags & 4) != 0 ? 1.0 : 0.0;
#ifdef WITH_SECTION
  gl_FragDepth = gl_FragCoord.z;
  // Where the line of sight has come through the plane: what is painted on the cut is measured there.
  vec3 way = is_parallel > 0.5 ? looking : normalize(world - eye);
  float across = dot(section.xyz, way);
  float back = abs(across) > 1e-4 ? max(0.0, (dot(section.xyz, world) - section.w) / across) : 0.0;
  vec3 on_cut = world - back * way;
  bool is_upright = abs(section.z) < 0.5;
  float stroke = (dot(on_cut, vec3(-section.y, section.x, 0.0)) + on_cut.z) / hatch;
  if (!is_upright) stroke = (on_cut.x + on_cut.y) / hatch;
  float stroke_size = max(fwidth(stroke), 1e-6), metre_size = max(fwidth(on_cut.z), 1e-6);
  // A roof that lies in the plane stays whole.
  if (dot(section.xyz, world) > section.w + 0.002) discard;
  if (!gl_FrontFacing) {
    // The inside is seen first only where the cut opens it, because volumes share no space: there the solid is painted. A wall
    // that two volumes share belongs to the one that is cut: it moves a little towards the cut.
    vec4 clip = matrix * vec4(world - 0.03 * back * way, 1.0);
    gl_FragDepth = clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0);
    vec3 cut = mix(cut_colour.rgb, own, 0.66);
    cut = mix(cut, edge_colour.rgb, 0.30 * line(abs(fract(stroke) - 0.5) / stroke_size, 0.4 * pixel));
    if (is_upright && with_storeys > 0.5 && storey.y > 0.0) {
      // Floors and roofs as in drawings: so thick, and never thinner than a line.
      float level = (on_cut.z - storey.x) / storey.y, under = (ceil(level - 1e-4) - level) * storey.y;
      float slab = 1.0 - smoothstep(-0.5, 0.5, (under - max(0.3, 1.2 * pixel * metre_size)) / metre_size);
      cut = mix(cut, mix(edge_colour.rgb, own, 0.18), slab * smoothstep(0.40, 0.16, metre_size / storey.y));
    }
    if ((flags & 32) != 0) cut = mix(cut, ground_colour.rgb, 0.25);
    if ((flags & 1) != 0) cut = mix(cut, vec3(1.0), 0.14);
    if ((flags & 2) != 0) cut = mix(cut, chosen_colour.rgb, 0.4);
    colour = vec4(cut, 1.0);
    // A number of its own, so that a line goes round what is cut.
    label = (label | 28u) ^ 0x80000000u;
    return;
  }
#else
  if (!gl_FrontFacing) normal = -normal;
#endif
  if ((flags & 2) != 0) own = mix(own, chosen_colour.rgb, 0.22);
  if ((flags & 1) != 0) own = mix(own, vec3(1.0), 0.14);
  own = mix(own, ground_colour.rgb, 0.72 * faint);
  // Derivatives want to be taken everywhere, also beside the façade.
  bool is_dressed = (flags & 16) != 0 && storey.y > 0.0;
  if (is_dressed) {
    vec3 dressed = facade_colour(own, number, world, ball.xyz, is_round, ball.w, normal, storey.xy);
    if (abs(normal.z) <= 0.7072) own = mix(own, dressed, 1.0 - 0.7 * faint);
  }
  vec3 shown = to_screen(lit(to_linear(own), world, normal));
  if (with_storeys > 0.5 && storey.y > 0.0 && abs(normal.z) < 0.93) {
    // On the ball itself, not on the triangles that stand for it: lines stay level however coarse these are.
    float height = is_round ? ball.z + normal.z * ball.w : world.z;
    float level = (height - storey.x) / storey.y;
    float per_pixel = fwidth(level);
    float near = abs(fract(level + 0.5) - 0.5) / max(per_pixel, 1e-6);
    float room = smoothstep(0.34, 0.12, per_pixel);
    shown = mix(shown, edge_colour.rgb, 0.34 * room * line(near, 0.35 * pixel) * (1.0 - 0.6 * faint));
    shown *= 1.0 - 0.05 * room * fract(level);
  }
  if ((flags & 32) != 0) {
    float stripe = abs(fract((world.x + world.y + world.z) / 2.4) - 0.5);
    shown = mix(shown, edge_colour.rgb, 0.22 * smoothstep(0.30, 0.36, stripe));
  }
  if (with_edges > 0.5 && (flags & 64) == 0) {
    float rim = centre_weight / max(fwidth(centre_weight), 1e-6);
    float crease = abs(reach - ball.w) / max(fwidth(reach), 1e-6);
    float edge = is_round ? 0.0 : line(rim, 0.55 * pixel);
    edge = max(edge, 0.6 * line(crease, 0.45 * pixel));
    shown = mix(shown, edge_colour.rgb, 0.62 * fineness * edge * (1.0 - 0.6 * faint));
  }
  colour = vec4(shown, 1.0);
}
)";

}  // namespace bl::desktop::shaders

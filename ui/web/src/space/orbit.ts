// How the picture is looked at: around a point, by angles and a distance. Plain numbers, so that tests need no screen.
import type { Point3 } from "./decode";

export interface Orbit {
  target: Point3; ///< [m]
  azimuth: number; ///< of the way that one looks, clockwise from north [rad]
  tilt: number; ///< how far one looks down [rad]
  distance: number; ///< [m]
}
export interface Box {
  low: Point3;
  high: Point3;
}

export const kFieldOfView = (32 * Math.PI) / 180; // from top to bottom
const kLeastTilt = 0.06,
  kMostTilt = Math.PI / 2 - 0.02,
  kNear = 0.12,
  kFar = 3, // times the distance from which all is seen
  kRoom = 1.05;

const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

// The least distance from which all corners of the box are in a picture of this shape, with a little room around them.
function fitting(box: Box, aspect: number, { target, azimuth, tilt }: Orbit): number {
  const tall = Math.tan(kFieldOfView / 2),
    wide = tall * aspect;
  let least = 1;
  for (let corner = 0; corner < 8; ++corner) {
    const [x, y, z] = [0, 1, 2].map((k) => ((corner >> k) & 1 ? box.high : box.low)[k as 0 | 1 | 2] - (target[k] as number)) as Point3;
    const right = x * Math.cos(azimuth) - y * Math.sin(azimuth),
      away = x * Math.sin(azimuth) + y * Math.cos(azimuth),
      up = away * Math.sin(tilt) + z * Math.cos(tilt),
      nearer = z * Math.sin(tilt) - away * Math.cos(tilt);
    least = Math.max(least, nearer + kRoom * Math.max(Math.abs(right) / wide, Math.abs(up) / tall));
  }
  return least;
}

/// All of it, from the south-west and above, as the reports draw it.
export function home(box: Box, aspect: number): Orbit {
  const { low, high } = box;
  const orbit: Orbit = {
    target: [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2] + 0.35 * (high[2] - low[2])],
    azimuth: Math.PI / 7,
    tilt: 0.56,
    distance: 1,
  };
  return { ...orbit, distance: fitting(box, aspect, orbit) };
}

/// Inside what makes sense: not below the ground, not lost in the distance.
export function bounded(orbit: Orbit, box: Box, aspect: number): Orbit {
  const { low, high } = box,
    whole = home(box, aspect).distance;
  return {
    target: orbit.target.map((value, k) => clamp(value, low[k] as number, high[k] as number)) as Point3,
    azimuth: ((orbit.azimuth % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI),
    tilt: clamp(orbit.tilt, kLeastTilt, kMostTilt),
    distance: clamp(orbit.distance, kNear * whole, kFar * whole),
  };
}

/// Where the eye is.
export function eye(orbit: Orbit): Point3 {
  const flat = Math.cos(orbit.tilt) * orbit.distance;
  return [
    orbit.target[0] - flat * Math.sin(orbit.azimuth),
    orbit.target[1] - flat * Math.cos(orbit.azimuth),
    orbit.target[2] + Math.sin(orbit.tilt) * orbit.distance,
  ];
}

/// The target moves over the ground by parts of the picture's height: to the right of it, and away from the eye.
export function moved(orbit: Orbit, right: number, away: number): Orbit {
  const metres = 2 * Math.tan(kFieldOfView / 2) * orbit.distance,
    x = right * metres,
    y = (away * metres) / Math.max(0.35, Math.sin(orbit.tilt));
  const sine = Math.sin(orbit.azimuth),
    cosine = Math.cos(orbit.azimuth),
    [tx, ty, tz] = orbit.target;
  return { ...orbit, target: [tx + x * cosine + y * sine, ty - x * sine + y * cosine, tz] };
}

/// On the way from one to another, the shorter way around.
export function between(from: Orbit, to: Orbit, share: number): Orbit {
  const mix = (a: number, b: number): number => a + share * (b - a);
  const turn = ((to.azimuth - from.azimuth + 3 * Math.PI) % (2 * Math.PI)) - Math.PI;
  return {
    target: from.target.map((value, k) => mix(value, to.target[k] as number)) as Point3,
    azimuth: from.azimuth + share * turn,
    tilt: mix(from.tilt, to.tilt),
    distance: mix(from.distance, to.distance),
  };
}

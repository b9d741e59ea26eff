// How the picture is looked at: around a point, by angles and a distance. Plain numbers, so that tests need no screen.
import type { Point3 } from "./decode";

export interface Orbit {
  target: Point3; ///< [m]
  azimuth: number; ///< of the way that one looks, clockwise from north [rad]
  tilt: number; ///< how far one looks down [rad]
  distance: number; ///< [m]
}
/// What the picture is of. `corners`: of the things in it, which need less room than the whole box where a few are high.
export interface Box {
  low: Point3;
  high: Point3;
  corners?: Point3[];
}

export const kFieldOfView = (32 * Math.PI) / 180; // from top to bottom
const kLeastTilt = 0.06,
  kMostTilt = Math.PI / 2 - 0.02,
  kNear = 0.12,
  kFar = 3, // times the distance from which all is seen
  kRoom = 1.05,
  kRounds = 8; // each of which halves at least what is left

const clamp = (value: number, low: number, high: number): number => Math.min(high, Math.max(low, value));

const corners_of = ({ low, high, corners }: Box): Point3[] =>
  corners && corners.length > 0
    ? corners
    : Array.from({ length: 8 }, (_, corner) => [0, 1, 2].map((k) => ((corner >> k) & 1 ? high : low)[k as 0 | 1 | 2]) as Point3);

/// A place as it is seen: to the right of the middle, above it, and nearer than the target [m].
export function seen({ target, azimuth, tilt }: Orbit, at: Point3): Point3 {
  const [x, y, z] = [0, 1, 2].map((k) => (at[k] as number) - (target[k] as number)) as Point3;
  const away = x * Math.sin(azimuth) + y * Math.cos(azimuth);
  return [x * Math.cos(azimuth) - y * Math.sin(azimuth), away * Math.sin(tilt) + z * Math.cos(tilt), z * Math.sin(tilt) - away * Math.cos(tilt)];
}

// The least distance from which all is in a picture of this shape, with a little room around it.
function fitting(corners: Point3[], aspect: number, orbit: Orbit): number {
  const tall = Math.tan(kFieldOfView / 2),
    wide = tall * aspect;
  let least = 1;
  for (const corner of corners) {
    const [right, up, nearer] = seen(orbit, corner);
    least = Math.max(least, nearer + kRoom * Math.max(Math.abs(right) / wide, Math.abs(up) / tall));
  }
  return least;
}

// What is near looks larger, so the middle of what stands there is not the middle of the picture: the target is moved over the ground
// until as much room is left on one side as on the other.
function centred(corners: Point3[], aspect: number, orbit: Orbit): Orbit {
  let now = { ...orbit, distance: fitting(corners, aspect, orbit) };
  for (let round = 0; round < kRounds; ++round) {
    const places = corners.map((corner) => seen(now, corner)),
      middle = (k: 0 | 1): number => {
        const shares = places.map((place) => place[k] / (now.distance - place[2]));
        return (Math.min(...shares) + Math.max(...shares)) / 2;
      };
    const height = 2 * Math.tan(kFieldOfView / 2);
    const next = moved(now, middle(0) / height, middle(1) / height);
    now = { ...next, distance: fitting(corners, aspect, next) };
  }
  return now;
}

/// All of it, from the south-west and above, as the reports draw it, and as large as the picture lets it be.
export function home(box: Box, aspect: number): Orbit {
  const { low, high } = box;
  const orbit: Orbit = {
    target: [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2] + 0.35 * (high[2] - low[2])],
    azimuth: Math.PI / 7,
    tilt: 0.56,
    distance: 1,
  };
  return centred(corners_of(box), aspect, orbit);
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

// The picture in three dimensions: what is in it, how it is lit, and who looks at it from where. It draws only when something changes.
import {
  BufferAttribute,
  BufferGeometry,
  CircleGeometry,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  Object3D,
  PCFSoftShadowMap,
  PerspectiveCamera,
  Raycaster,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
  sRGBEncoding,
} from "three";
import type { ShapeContent, SpaceContent } from "./contents";
import { lines_of } from "../plan_names";
import { Body, Point3, cell_body, lines_body, prism_body, surface_body, terrain_body } from "./decode";
import { follow_fingers } from "./fingers";
import { Label, Rectangle, placed } from "./names";
import { Box, Orbit, between, bounded, eye, home, kFieldOfView, moved } from "./orbit";

/// What the plan says of a thing, as far as it is seen here.
export interface Look {
  kind: string;
  fill: string;
  name: string;
}
/// A mark at a place of the scene [m].
export interface Mark {
  place: Point3;
  letter: string;
  tone: string;
}
export interface Looks {
  background: string;
  ink: string;
  accent: string;
  ground: string;
  isDark: boolean;
}
export interface Options {
  canvas: HTMLCanvasElement;
  overlay: HTMLElement; ///< gets names and marks
  looks: Looks;
  isCalm: boolean; ///< nothing glides
  onTap(place: Point3, node: string | null): void;
  onLook(azimuth: number): void; ///< where north is has changed [rad]
}
export type Step = "turn_left" | "turn_right" | "tilt_up" | "tilt_down" | "left" | "right" | "up" | "down" | "in" | "out" | "home";

interface Thing {
  content: ShapeContent;
  fill: string;
  mesh: Mesh<BufferGeometry, MeshLambertMaterial> | null;
  lines: LineSegments<BufferGeometry, LineBasicMaterial> | null;
  top: Point3;
  size: number;
}

// Of names, as the style sheet has them, in parts of the letters' height.
const kNameWeight = 650,
  kNamePadding = 0.8,
  kNameLine = 1.3;
const kFine = 40, // so many volumes are divided finely
  kGlide = 260, // [ms]
  kMostNames = 40,
  kLongLine = 12; // letters of a name, before it stands in two lines

export class Picture {
  isMoving = false; ///< one finger moves
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera((kFieldOfView * 180) / Math.PI, 1, 1, 1000);
  private readonly sun = new DirectionalLight(0xfffaf0, 0.62);
  private readonly ground: Mesh<CircleGeometry, MeshLambertMaterial>;
  private readonly fog: Fog;
  private readonly things = new Map<string, Thing>();
  private readonly stop: () => void;
  private readonly watcher: ResizeObserver | null;
  private names = new Map<string, Look>();
  private marks: Mark[] = [];
  private origin: Point3 = [0, 0, 0];
  private box: Box = { low: [-10, -10, 0], high: [10, 10, 10] };
  private orbit: Orbit | null = null;
  private glide: { from: Orbit; to: Orbit; begun: number } | null = null;
  private selected: string | null = null;
  private due = 0;
  private readonly pen = document.createElement("canvas").getContext("2d") as CanvasRenderingContext2D; // measures names
  private hasHome = false;
  private isAtHome = true; // nobody has turned or moved it

  /// Throws where there is no WebGL.
  constructor(private readonly options: Options) {
    const { canvas, looks } = options;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "low-power" });
    this.renderer.outputEncoding = sRGBEncoding;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.camera.up.set(0, 0, 1);
    const background = new Color(looks.background).convertSRGBToLinear();
    this.renderer.setClearColor(background, 1);
    this.fog = new Fog(background, 1, 10);
    this.scene.fog = this.fog;
    const sky = new HemisphereLight(0xf4f8ff, looks.isDark ? 0x59606b : 0xb8ab98, 0.52);
    sky.position.set(0, 0, 1);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.ground = new Mesh(new CircleGeometry(1, 64), new MeshLambertMaterial({ color: new Color(looks.ground).convertSRGBToLinear() }));
    this.ground.receiveShadow = true;
    this.scene.add(sky, this.sun, this.sun.target, this.ground);
    this.stop = follow_fingers(canvas, {
      turn: (right, down) => this.go({ azimuth: this.now.azimuth + 2.6 * right, tilt: this.now.tilt + 2 * down }),
      move: (right, down) => this.set(moved(this.now, -right, down)),
      zoom: (factor) => this.go({ distance: this.now.distance / factor }),
      tap: (x, y) => this.tap(x, y),
      isMoving: () => this.isMoving,
    });
    this.watcher = typeof ResizeObserver === "undefined" ? null : new ResizeObserver(() => this.resize());
    this.watcher?.observe(canvas);
    canvas.addEventListener("webglcontextrestored", () => this.invalidate(true));
    this.resize();
  }

  dispose(): void {
    this.stop();
    this.watcher?.disconnect();
    if (this.due) cancelAnimationFrame(this.due);
    for (const id of [...this.things.keys()]) this.remove(id);
    this.ground.geometry.dispose();
    this.ground.material.dispose();
    this.sun.shadow.map?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.options.overlay.textContent = "";
  }

  // --- What is in the picture ---------------------------------------------------------------------------------------

  /// The view as it is now: what has not changed is the same object as before.
  show(view: Record<string, unknown>, names: Map<string, Look>, marks: Mark[], selected: string | null): void {
    const space = view.space as SpaceContent | undefined;
    if (!space) return;
    const isElsewhere = space.origin.some((value, k) => value !== this.origin[k]);
    this.origin = space.origin;
    const cells = Object.values(view).filter((one) => (one as ShapeContent | undefined)?.t === "cell").length;
    let isChanged = isElsewhere;
    for (const id of [...this.things.keys()])
      if (view[id] === undefined) {
        this.remove(id);
        isChanged = true;
      }
    for (const [id, content] of Object.entries(view) as [string, ShapeContent][]) {
      if (id === "space") continue;
      const node = id.replace(/^n\//, ""),
        fill = names.get(node)?.fill ?? "#b9b6ae",
        old = this.things.get(id);
      if (old && old.content === content && old.fill === fill) continue;
      this.remove(id);
      this.add(id, content, fill, names.get(node)?.kind ?? "", cells <= kFine ? 8 : 4);
      isChanged = true;
    }
    const isPicked = selected !== this.selected;
    this.selected = selected;
    const isMarked = JSON.stringify(marks) !== JSON.stringify(this.marks) || [...names].some(([id, one]) => this.names.get(id)?.name !== one.name);
    this.marks = marks;
    this.names = names;
    if (isChanged) this.measure(space);
    if (isChanged || isPicked) this.paint();
    if (isChanged || isPicked || isMarked) this.invalidate(isChanged);
  }

  private add(id: string, content: ShapeContent, fill: string, kind: string, steps: number): void {
    const thing: Thing = { content, fill, mesh: null, lines: null, top: [0, 0, 0], size: 0 };
    this.things.set(id, thing); // also of a kind that is not known here: else it would be new each time
    const body = body_of(content, steps);
    if (!body) return;
    const { looks } = this.options,
      isThing = content.t === "cell" || content.t === "prism" || content.t === "surface";
    const colour = new Color(content.t === "terrain" ? looks.ground : content.t === "lines" ? looks.ink : /^#/.test(fill) ? fill : "#b9b6ae");
    if (body.places.length > 0) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(body.places), 3));
      geometry.setAttribute("normal", new BufferAttribute(new Float32Array(body.normals), 3));
      const material = new MeshLambertMaterial({ color: colour.convertSRGBToLinear(), polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 });
      if (content.t === "lines") {
        // A street lies on the ground and hides nothing of it.
        Object.assign(material, { transparent: true, opacity: 0.16, depthWrite: false, polygonOffsetFactor: -2, polygonOffsetUnits: -2 });
      }
      if ((content.t === "cell" || content.t === "surface") && (content.storey ?? 0) > 50) storeys(material, (content.bottom ?? 0) / 100, (content.storey as number) / 100);
      thing.mesh = new Mesh(geometry, material);
      thing.mesh.castShadow = isThing;
      thing.mesh.receiveShadow = true;
      thing.mesh.userData.id = id;
      geometry.computeBoundingBox();
      const { min, max } = geometry.boundingBox ?? { min: new Vector3(), max: new Vector3() };
      thing.top = [(min.x + max.x) / 2, (min.y + max.y) / 2, max.z];
      thing.size = max.x - min.x + max.y - min.y;
      this.scene.add(thing.mesh);
    }
    if (body.lines.length > 0) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(new Float32Array(body.lines), 3));
      thing.lines = new LineSegments(geometry, new LineBasicMaterial({ transparent: true }));
      thing.lines.userData.isOutline = isThing;
      thing.lines.userData.isSite = kind === "boundary";
      this.scene.add(thing.lines);
    }
  }

  private remove(id: string): void {
    const thing = this.things.get(id);
    if (!thing) return;
    for (const part of [thing.mesh, thing.lines])
      if (part) {
        this.scene.remove(part as Object3D);
        part.geometry.dispose();
        part.material.dispose();
      }
    this.things.delete(id);
  }

  // The ground and the sun fit what there is; the first time, so does the place of the eye.
  private measure(space: SpaceContent): void {
    const low = new Vector3(Infinity, Infinity, Infinity),
      high = new Vector3(-Infinity, -Infinity, -Infinity),
      corners: Point3[] = [];
    for (const one of this.core())
      for (const part of [one.mesh, one.lines]) {
        if (!part) continue;
        if (!part.geometry.boundingBox) part.geometry.computeBoundingBox();
        if (!part.geometry.boundingBox) continue;
        low.min(part.geometry.boundingBox.min);
        high.max(part.geometry.boundingBox.max);
        const { min, max } = part.geometry.boundingBox;
        for (const x of [min.x, max.x]) for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) corners.push([x, y, z]);
      }
    if (!(high.x > low.x) || !(high.y > low.y)) return;
    this.box = { low: [low.x, low.y, low.z], high: [high.x, high.y, Math.max(high.z, low.z + 1)], corners };
    const size = Math.hypot(high.x - low.x, high.y - low.y),
      middle = new Vector3((low.x + high.x) / 2, (low.y + high.y) / 2, low.z);
    const hasTerrain = [...this.things.values()].some((one) => one.content.t === "terrain");
    this.ground.visible = !hasTerrain;
    this.ground.position.set(middle.x, middle.y, (space.ground ?? 0) / 100 - 0.05);
    this.ground.scale.setScalar(8 * size);
    // From the south-west, as shadows of drawings fall; it lights a ball around all that stands.
    this.sun.position.set(middle.x - 0.75 * size, middle.y - 0.55 * size, middle.z + 1.1 * size);
    this.sun.target.position.copy(middle);
    this.sun.target.updateMatrixWorld();
    const shadow = this.sun.shadow.camera,
      reach = 0.62 * size + (high.z - low.z);
    Object.assign(shadow, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * size, far: 3.5 * size });
    shadow.updateProjectionMatrix();
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = size / 900;
    if (!this.hasHome) {
      this.hasHome = true;
      this.orbit = home(this.box, this.aspect());
    }
  }

  // The volumes and the site, or whatever else there is: far streets do not make the rest small.
  private core(): Thing[] {
    const all = [...this.things.entries()],
      near = all.filter(([id, one]) => this.isVolume(id, one) || id.startsWith("n/site/"));
    return (near.length > 0 ? near : all).map(([, one]) => one);
  }

  // A volume that stands comes as a surface, as existing buildings do.
  private isVolume(id: string, one: Thing): boolean {
    const kind = this.names.get(id.slice(2))?.kind;
    return kind === undefined ? one.content.t === "cell" || one.content.t === "prism" : kind === "volume";
  }

  private paint(): void {
    const { looks } = this.options,
      accent = new Color(looks.accent).convertSRGBToLinear(),
      ink = new Color(looks.ink).convertSRGBToLinear();
    for (const [id, thing] of this.things) {
      const isPicked = this.selected !== null && id === `n/${this.selected}`;
      if (thing.mesh) thing.mesh.material.emissive.copy(accent).multiplyScalar(isPicked ? 0.32 : 0);
      if (!thing.lines) continue;
      const { isOutline, isSite } = thing.lines.userData as { isOutline: boolean; isSite: boolean };
      thing.lines.material.color.copy(isPicked || isSite ? accent : ink);
      thing.lines.material.opacity = isPicked || isSite ? 1 : isOutline ? 0.55 : 0.4;
    }
  }

  // --- Looking ------------------------------------------------------------------------------------------------------

  private get now(): Orbit {
    return this.glide?.to ?? this.orbit ?? home(this.box, this.aspect());
  }

  private aspect(): number {
    const { clientWidth, clientHeight } = this.options.canvas;
    return clientWidth > 0 && clientHeight > 0 ? clientWidth / clientHeight : 1;
  }

  private set(next: Orbit): void {
    this.glide = null;
    this.isAtHome = false;
    this.orbit = bounded(next, this.box, this.aspect());
    this.invalidate(false);
  }

  private go(change: Partial<Orbit>): void {
    this.set({ ...this.now, ...change });
  }

  /// What the buttons and keys do.
  step(step: Step): void {
    const { now } = this,
      fifth = 0.2;
    const next: Record<Step, Orbit> = {
      turn_left: { ...now, azimuth: now.azimuth - Math.PI / 8 },
      turn_right: { ...now, azimuth: now.azimuth + Math.PI / 8 },
      tilt_up: { ...now, tilt: now.tilt + 0.2 },
      tilt_down: { ...now, tilt: now.tilt - 0.2 },
      left: moved(now, -fifth, 0),
      right: moved(now, fifth, 0),
      up: moved(now, 0, fifth),
      down: moved(now, 0, -fifth),
      in: { ...now, distance: now.distance / 1.4 },
      out: { ...now, distance: now.distance * 1.4 },
      home: home(this.box, this.aspect()),
    };
    const to = bounded(next[step], this.box, this.aspect());
    if (this.options.isCalm || !this.orbit) this.set(to);
    this.isAtHome = step === "home";
    if (this.options.isCalm || !this.orbit) return;
    this.glide = { from: this.orbit, to, begun: performance.now() };
    this.invalidate(false);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.options.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    // More points than this cost a phone time and show nothing more.
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    // Another shape of the picture has room for more or less.
    if (this.hasHome && this.isAtHome && !this.glide) this.orbit = home(this.box, this.aspect());
    this.invalidate(false);
  }

  private tap(x: number, y: number): void {
    const { clientWidth, clientHeight } = this.options.canvas,
      ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
    const bodies = [...this.things.values()].filter((one) => one.mesh).map((one) => one.mesh as Mesh);
    const hit = ray.intersectObjects([...bodies, this.ground].filter((one) => one.visible), false)[0];
    if (!hit) return;
    const id = hit.object.userData.id as string | undefined,
      at = (value: number, k: 0 | 1 | 2): number => Math.round((value + this.origin[k]) * 10) / 10;
    this.options.onTap([at(hit.point.x, 0), at(hit.point.y, 1), at(hit.point.z, 2)], id?.startsWith("n/") ? id.slice(2) : null);
  }

  // --- Drawing ------------------------------------------------------------------------------------------------------

  private invalidate(withShadows: boolean): void {
    if (withShadows) this.renderer.shadowMap.needsUpdate = true;
    if (!this.due) this.due = requestAnimationFrame((now) => this.draw(now));
  }

  private draw(now: number): void {
    this.due = 0;
    if (this.glide) {
      const share = Math.min(1, Math.max(0, (now - this.glide.begun) / kGlide));
      this.orbit = between(this.glide.from, this.glide.to, share * share * (3 - 2 * share));
      if (share === 1) this.glide = null;
      else this.invalidate(false);
    }
    if (!this.orbit) return;
    const [x, y, z] = eye(this.orbit),
      [tx, ty, tz] = this.orbit.target,
      { distance } = this.orbit;
    const size = Math.hypot(this.box.high[0] - this.box.low[0], this.box.high[1] - this.box.low[1]);
    this.camera.position.set(x, y, z);
    this.camera.lookAt(tx, ty, tz);
    this.camera.near = Math.max(0.5, distance / 60);
    this.camera.far = distance + 9 * size;
    this.camera.updateProjectionMatrix();
    this.fog.near = distance + 0.9 * size;
    this.fog.far = distance + 3.2 * size;
    this.renderer.render(this.scene, this.camera);
    this.label();
    this.options.onLook(this.orbit.azimuth);
  }

  // Where a place of the model is in the picture; nothing where it is outside.
  private point(at: Point3): { x: number; y: number } | null {
    const { clientWidth, clientHeight } = this.options.canvas,
      point = new Vector3(at[0], at[1], at[2]).project(this.camera);
    if (point.z > 1 || Math.abs(point.x) > 1 || Math.abs(point.y) > 1) return null;
    return { x: ((point.x + 1) / 2) * clientWidth, y: ((1 - point.y) / 2) * clientHeight };
  }

  // Names stand above what they name, the nearest first; one that would lie on another is left out.
  private label(): void {
    const { overlay, canvas } = this.options,
      style = getComputedStyle(overlay),
      font = parseFloat(style.fontSize) || 12,
      pen = this.pen;
    pen.font = `${kNameWeight} ${font}px ${style.fontFamily}`;
    const out: HTMLElement[] = [];
    const write = (text: string, kind: string, x: number, y: number): void => {
      const span = document.createElement("span");
      span.className = kind;
      span.textContent = text;
      span.style.left = `${x}px`;
      span.style.top = `${y}px`;
      out.push(span);
    };
    const taken = this.others();
    for (const { place, letter, tone } of this.marks) {
      const at = this.point(place.map((value, k) => value - (this.origin[k] as number)) as Point3);
      if (!at) continue;
      taken.push({ left: at.x - font, top: at.y - 1.6 * font, width: 2 * font, height: 1.6 * font });
      write(letter, `mark ${tone}`, at.x, at.y);
    }
    const eyes = this.camera.position;
    const named = [...this.things]
      .filter(([id, one]) => this.isVolume(id, one) && this.names.get(id.slice(2))?.name)
      .map(([id, one]) => ({ id, one, far: eyes.distanceTo(new Vector3(...one.top)) / Math.max(1, one.size) }))
      .sort((a, b) => (a.id === `n/${this.selected}` ? -1 : b.id === `n/${this.selected}` ? 1 : a.far - b.far))
      .slice(0, kMostNames);
    const labels: (Label & { lines: string[] })[] = [];
    for (const { id, one } of named) {
      const at = this.point(one.top),
        lines = lines_of(this.names.get(id.slice(2))?.name ?? "", kLongLine);
      const width = Math.max(...lines.map((line) => pen.measureText(line).width)) + kNamePadding * font;
      if (at) labels.push({ ...at, lines, width, height: lines.length * kNameLine * font });
    }
    placed(labels, taken, { width: canvas.clientWidth, height: canvas.clientHeight }).forEach((at, i) => {
      if (at) write((labels[i] as { lines: string[] }).lines.join("\n"), "name", at.left + at.width / 2, at.top + at.height);
    });
    overlay.replaceChildren(...out);
  }

  // What else stands on the picture: north, buttons, a remark.
  private others(): Rectangle[] {
    const { overlay, canvas } = this.options,
      own = canvas.getBoundingClientRect();
    const beside = overlay.closest(".seen")?.querySelectorAll(".north, .remark, .zoom, .pad, .switch") ?? [];
    return [...beside].map((one) => {
      const { left, top, width, height } = one.getBoundingClientRect();
      return { left: left - own.left, top: top - own.top, width, height };
    });
  }
}

function body_of(content: ShapeContent, steps: number): Body | null {
  switch (content.t) {
    case "cell":
      return cell_body(content, steps);
    case "prism":
      return prism_body(content);
    case "surface":
      return surface_body(content);
    case "lines":
      return lines_body(content);
    case "terrain":
      return terrain_body(content);
    default:
      return null; // a newer server may know more
  }
}

// Lines at the heights of floors, on walls only; finer than a point they fade away.
function storeys(material: MeshLambertMaterial, bottom: number, height: number): void {
  // WebGL 1 has derivatives only where they are asked for; the types know this of other materials.
  Object.assign(material, { extensions: { derivatives: true } });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.storey = { value: new Vector2(bottom, height) };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying float floor_height;\nvarying float upright;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nfloor_height = position.z;\nupright = 1.0 - abs(normal.z);");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nuniform vec2 storey;\nvarying float floor_height;\nvarying float upright;")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        float level = (floor_height - storey.x) / storey.y, fine = fwidth(level);
        float edge = abs(fract(level + 0.5) - 0.5);
        float seen = (1.0 - smoothstep(0.03, 0.03 + 1.2 * fine, edge)) * smoothstep(0.6, 0.15, fine) * smoothstep(0.05, 0.3, upright);
        diffuseColor.rgb *= 1.0 - 0.2 * seen;`,
      );
  };
}

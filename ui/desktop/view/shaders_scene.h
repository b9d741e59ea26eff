// Shader texts of everything around the volumes: ground, translucent surfaces, lines, blur, and the last pass over the picture.
#pragma once

namespace bl::desktop::shaders {

// One quad that holds the ground as far as it matters.
inline constexpr const char* kGroundVertex = R"(
uniform mat4 matrix;
uniform vec4 plot;
uniform float level;
out vec3 world;
void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  world = vec3(plot.xy + plot.z * corner, level);
  gl_Position = matrix * vec4(world, 1.0);
}
)";

inline constexpr const char* kGroundFragment = R"(
uniform vec4 plot, ground_colour, sky_colour, grid_colour, section;
uniform vec2 grid_origin;
uniform float grid;
in vec3 world;
layout(location = 0) out vec4 colour;
layout(location = 1) out uint label;

float ruled(float distance) {
  vec2 at = (world.xy - grid_origin) / distance, per_pixel = fwidth(at);
  vec2 near = abs(fract(at + 0.5) - 0.5) / max(per_pixel, vec2(1e-6));
  float room = 1.0 - smoothstep(0.1, 0.4, max(per_pixel.x, per_pixel.y));
  return room * (1.0 - smoothstep(0.0, 1.1, min(near.x, near.y)));
}

void main() {
  label = 0u;
  float far = length(world.xy - plot.xy) / plot.z;
  vec3 shown = mix(ground_colour.rgb, grid_colour.rgb, 0.5 * ruled(grid) + 0.5 * ruled(5.0 * grid));
  if (shadow_strength > 0.0) {
    float direct = sunlight(world, vec3(0.0, 0.0, 1.0));
    float near = surroundings(world).y;
    shown *= (0.76 + 0.24 * direct) * (1.0 - 0.42 * near);
  }
  // After the derivatives, which want to be taken everywhere.
  if (dot(section.xyz, world) > section.w) discard;
  float seen = 1.0 - smoothstep(0.35, 0.98, far);
  colour = vec4(mix(sky_colour.rgb, shown, seen), 1.0);
}
)";

// Translucent surfaces, and the sides of bodies of shade.
inline constexpr const char* kSurfaceVertex = R"(
uniform mat4 matrix;
// The share by which it comes nearer than volumes and ground, which surfaces lie on in places.
uniform float nearer;
layout(location = 0) in vec3 place;
out vec3 world;
void main() {
  world = place;
  gl_Position = matrix * vec4(place, 1.0);
  gl_Position.z -= nearer * gl_Position.w;
}
)";

inline constexpr const char* kSurfaceFragment = R"(
uniform vec4 paint, section;
// 1: facets are told apart a little by where they look, so that a body has a shape.
uniform float relief;
in vec3 world;
layout(location = 0) out vec4 colour;
void main() {
  vec3 normal = normalize(cross(dFdx(world), dFdy(world)));
  if (dot(section.xyz, world) > section.w) discard;
  float turned = 0.5 + 0.5 * dot(normal, normalize(vec3(0.55, -0.8, 0.25)));
  colour = vec4(relief > 0.0 ? mix(paint.rgb * 0.7, paint.rgb * 1.25, turned) : paint.rgb, paint.a);
}
)";

// Lines as quads of a width in pixels, soft at both sides. Where one goes on as another, both have the same two corners: there is
// neither a gap nor a place that is painted twice.
inline constexpr const char* kLineVertex = R"(
uniform mat4 matrix;
uniform vec2 size;
uniform float pixel, bias;
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 paint;
layout(location = 3) in vec2 shape;
layout(location = 4) in vec3 came;
layout(location = 5) in vec3 goes;
out vec4 tint;
out float across, half_width;
const float least = 1e-4;
// Towards the corner that is shared with the neighbour, times how much farther it is than the side; `past` is its other end.
vec2 corner(vec2 aside, vec2 here, vec4 past, bool is_before, float reach) {
  if (past.w < least) return aside;
  vec2 there = past.xy / past.w * size * 0.5, way = is_before ? here - there : there - here;
  float far = length(way);
  if (far < least) return aside;
  vec2 mean = aside + vec2(-way.y, way.x) / far;
  float fold = length(mean);
  if (fold < 0.02) return aside;
  mean /= fold;
  float share = dot(mean, aside);
  // A sharp turn, or one between short pieces, would throw its corner far away: there the line gets narrower.
  bool is_near = share > 0.4 && half_width * sqrt(1.0 - min(1.0, share * share)) <= share * min(far, reach);
  return is_near ? mean / share : mean;
}
void main() {
  vec4 a = matrix * vec4(from, 1.0), b = matrix * vec4(to, 1.0);
  if (a.w < least && b.w < least) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  bool is_whole = a.w >= least && b.w >= least;
  if (a.w < least) a = mix(a, b, (least - a.w) / (b.w - a.w));
  if (b.w < least) b = mix(b, a, (least - b.w) / (a.w - b.w));
  vec2 on_a = a.xy / a.w * size * 0.5, on_b = b.xy / b.w * size * 0.5;
  vec2 along = on_b - on_a;
  float reach = length(along);
  along = reach > 1e-4 ? along / reach : vec2(1.0, 0.0);
  vec2 aside = vec2(-along.y, along.x);
  half_width = 0.5 * max(1.0, shape.x * pixel);
  float side = (gl_VertexID & 1) == 0 ? -1.0 : 1.0;
  bool is_end = gl_VertexID >= 2;
  vec4 clip = is_end ? b : a;
  across = side * (half_width + 1.0);
  vec3 on = is_end ? goes : came;
  if (is_whole && dot(on, on) > 0.0)
    aside = corner(aside, is_end ? on_b : on_a, matrix * vec4(is_end ? to + goes : from - came, 1.0), !is_end, reach);
  clip.xy += aside * across / (size * 0.5) * clip.w;
  // Nearer by a share of the distance, a larger one for wide lines: the ground that their sides lie on is nearer than their middle.
  clip.z -= bias * (0.002 + 0.003 * half_width);
  tint = paint;
  if (bias <= 0.0) tint.a *= shape.y;
  gl_Position = clip;
}
)";

inline constexpr const char* kLineFragment = R"(
in vec4 tint;
in float across, half_width;
layout(location = 0) out vec4 colour;
void main() {
  float cover = clamp(half_width + 0.5 - abs(across), 0.0, 1.0);
  if (tint.a * cover <= 0.0) discard;
  colour = vec4(tint.rgb, tint.a * cover);
}
)";

inline constexpr const char* kWholeVertex = R"(
out vec2 at;
void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* kBlurFragment = R"(
uniform sampler2D picture;
uniform vec2 way;
in vec2 at;
layout(location = 0) out vec2 blurred;
void main() {
  vec2 sum = vec2(0.0);
  float total = 0.0;
  for (int i = -7; i <= 7; ++i) {
    float w = exp(-float(i * i) / 22.0);
    sum += w * texture(picture, at + float(i) * way).xy;
    total += w;
  }
  blurred = sum / total;
}
)";

// Outlines where one volume ends before another, softened; and a bright one around what is chosen or pointed at. A label has two
// bits for these, three for how much of its lines the volume carries, and the volume's number above them; 0 is no volume.
inline constexpr const char* kFinishFragment = R"(
uniform sampler2D picture;
uniform usampler2D labels;
uniform vec4 edge_colour, chosen_colour, hovered_colour;
uniform float with_edges;
uniform int reach;
in vec2 at;
layout(location = 0) out vec4 colour;

float fineness_of(uint label) { return float((label >> 2) & 7u) / 7.0; }
uint label_at(ivec2 p, ivec2 size) { return texelFetch(labels, clamp(p, ivec2(0), size - 1), 0).r; }

void main() {
  ivec2 size = textureSize(labels, 0), here = ivec2(gl_FragCoord.xy);
  uint own = label_at(here, size);
  vec3 shown = texelFetch(picture, here, 0).rgb;
  float chosen = 0.0, hovered = 0.0, differing = 0.0;
  for (int k = 0; k < 8; ++k) {
    ivec2 way = ivec2(round(float(reach) * vec2(cos(0.7854 * float(k)), sin(0.7854 * float(k)))));
    uint other = label_at(here + way, size);
    if (other == own) continue;
    differing += 1.0;
    if (((other | own) & 2u) != 0u && (other & 2u) != (own & 2u)) chosen += 1.0;
    if (((other | own) & 1u) != 0u) hovered += 1.0;
  }
  // Most of the picture is no outline. A loop without turns is left at once, also where branches are not: in software.
  float others = 0.0, fineness = fineness_of(own);
  vec3 sum = vec3(0.0);
  int turns = differing > 0.0 ? 9 : 0;
  for (int k = 0; k < turns; ++k) {
    ivec2 at_neighbour = clamp(here + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), size - 1);
    uint other = texelFetch(labels, at_neighbour, 0).r;
    if (other == own) continue;
    others += 1.0;
    if (own == 0u) fineness = max(fineness, fineness_of(other));
    sum += texelFetch(picture, at_neighbour, 0).rgb;
  }
  if (others > 0.0) {
    shown = mix(shown, sum / others, min(0.5, others / 12.0));
    if (with_edges > 0.5) shown = mix(shown, edge_colour.rgb, 0.62 * fineness * clamp(others / 5.0, 0.0, 1.0));
  }
  shown = mix(shown, hovered_colour.rgb, clamp(hovered / 3.0, 0.0, 1.0));
  shown = mix(shown, chosen_colour.rgb, clamp(chosen / 3.0, 0.0, 1.0));
  colour = vec4(shown, 1.0);
}
)";

}  // namespace bl::desktop::shaders

// Shader texts of pictures in the scene: as they are, veiled, or as an empty frame.
#pragma once

namespace bl::desktop::shaders {

inline constexpr const char* kPictureVertex = R"(
uniform mat4 matrix;
uniform vec3 lower_left, to_right, to_top;
out vec3 world;
out vec2 seen;
void main() {
  seen = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  world = lower_left + seen.x * to_right + seen.y * to_top;
  gl_Position = matrix * vec4(world, 1.0);
  // On the ground it lies a hair above it.
  gl_Position.z -= 1e-4 * gl_Position.w;
}
)";

inline constexpr const char* kPictureFragment = R"(
uniform sampler2D picture;
uniform vec4 section, frame_colour, ground_colour;
uniform float opacity, aspect;
uniform int orientation, standing;
in vec3 world;
in vec2 seen;
layout(location = 0) out vec4 colour;

// From the place that people see (from the upper left) to the place where it is stored, by the eight orientations of EXIF.
vec2 stored(vec2 p) {
  if (orientation == 2) return vec2(1.0 - p.x, p.y);
  if (orientation == 3) return 1.0 - p;
  if (orientation == 4) return vec2(p.x, 1.0 - p.y);
  if (orientation == 5) return p.yx;
  if (orientation == 6) return vec2(p.y, 1.0 - p.x);
  if (orientation == 7) return vec2(1.0 - p.y, 1.0 - p.x);
  if (orientation == 8) return vec2(1.0 - p.y, p.x);
  return p;
}

void main() {
  if (dot(section.xyz, world) > section.w) discard;
  vec2 p = vec2(seen.x, 1.0 - seen.y), size = max(fwidth(p), vec2(1e-6));
  vec2 rim = min(p, 1.0 - p) / size;
  float frame = 1.0 - smoothstep(1.2, 2.4, min(rim.x, rim.y));
  vec2 at = vec2(p.x * aspect, p.y);
  if (standing == 2) {
    // Nothing to show: a frame with a cross.
    float cross_line = min(abs(p.x - p.y) / (size.x + size.y), abs(p.x + p.y - 1.0) / (size.x + size.y));
    float ink = max(frame, 0.7 * (1.0 - smoothstep(0.4, 1.2, cross_line)));
    colour = vec4(mix(ground_colour.rgb, frame_colour.rgb, ink), max(0.55, ink) * max(opacity, 0.3));
    return;
  }
  vec3 shown;
  if (standing == 1) {
    // Eight by eight blots of it, and a hatch over them: nobody is to be recognised.
    vec2 texels = vec2(textureSize(picture, 0));
    float level = max(0.0, log2(max(texels.x, texels.y)) - 3.0);
    shown = mix(textureLod(picture, stored(p), level).rgb, ground_colour.rgb, 0.45);
    float way = (at.x + at.y) * 18.0, width = fwidth(way);
    float hatch = 1.0 - smoothstep(0.08, 0.08 + width, abs(fract(way) - 0.5));
    shown = mix(shown, frame_colour.rgb, 0.75 * hatch * smoothstep(1.0, 0.4, width));
  } else {
    vec4 texel = texture(picture, stored(p));
    shown = texel.rgb;
    if (texel.a < 0.01) discard;
  }
  colour = vec4(mix(shown, frame_colour.rgb, 0.8 * frame), opacity);
}
)";

}  // namespace bl::desktop::shaders

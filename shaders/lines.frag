#version 330 core
flat in vec2 a;
flat in vec2 b;
flat in vec2 split_a;
flat in vec2 split_b;
flat in vec4 shade;
flat in float radius;
uniform vec2 corner;    // px: lower left corner of the viewport
uniform float opacity;
uniform float already;  // opacity that the same line was drawn with before: both together give the line's own
out vec4 fragment;

void main() {
  vec2 p = gl_FragCoord.xy - corner;
  vec2 ab = b - a;
  float along = clamp(dot(p - a, ab) / max(dot(ab, ab), 1e-12), 0.0, 1.0);
  float coverage = clamp(radius + 0.5 - distance(p, a + along * ab), 0.0, 1.0);
  bool mine = dot(p - a, split_a) <= 0.0 && dot(p - b, split_b) <= 0.0;
  if (!mine || coverage == 0.0) discard;
  float alpha = shade.a * coverage;
  fragment = vec4(shade.rgb, opacity * alpha * (1.0 - already) / (1.0 - already * alpha));
}

#version 330 core
// A disk; its edge is antialiased by turning alpha into coverage of the samples.
flat in vec3 shade;
uniform float size;  // px
out vec4 fragment;

void main() {
  float from_edge = 0.5 * size - size * length(gl_PointCoord - 0.5);
  fragment = vec4(shade, clamp(from_edge + 0.5, 0.0, 1.0));
}

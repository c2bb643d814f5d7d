#version 330 core
// Scan points, fading a little into the background with depth.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 colour;
uniform mat4 clip_from_view;
uniform mat4 view_from_local;
uniform float size;  // px
uniform float set_back;  // m
uniform vec2 fade_depths;  // m: where the fading begins and ends
uniform float farthest_fade;
uniform vec3 background;
flat out vec3 shade;

void main() {
  vec4 view = view_from_local * vec4(position, 1.0);
  float depth = clamp((-view.z - fade_depths.x) / (fade_depths.y - fade_depths.x), 0.0, 1.0);
  shade = mix(background, colour.rgb, colour.a * (1.0 - farthest_fade * depth));
  bool absent = colour.a == 0.0 || position.x > 1e30;
  gl_Position = absent ? vec4(2.0, 2.0, 2.0, 1.0) : clip_from_view * view;
  vec4 behind = clip_from_view * (view - vec4(0.0, 0.0, set_back, 0.0));
  if (!absent) gl_Position.z = min(behind.z / behind.w, 1.0) * gl_Position.w;
  gl_PointSize = size;
}

#version 330 core
// Two-sided soft shading by two lights that travel with the camera. Colours are sRGB, the light is summed in linear
// light. A face seen square on keeps its colour, so that colour maps read true.
in vec3 normal_view;
in vec3 to_eye_view;
in vec4 shade;
uniform float lit;  // 1 or 0
out vec4 fragment;

const vec3 kKeyDirection = vec3(-0.36, 0.48, 0.80);
const vec3 kFillDirection = vec3(0.64, -0.48, 0.60);
const float kAmbient = 0.36, kKey = 0.64, kFill = 0.21;

void main() {
  vec3 normal = normalize(normal_view);
  if (dot(normal, to_eye_view) < 0.0) normal = -normal;
  float light = kAmbient + kKey * max(dot(normal, kKeyDirection), 0.0) + kFill * max(dot(normal, kFillDirection), 0.0);
  vec3 linear = pow(shade.rgb, vec3(2.2)) * mix(1.0, light, lit);
  fragment = vec4(pow(linear, vec3(1.0 / 2.2)), shade.a);
}

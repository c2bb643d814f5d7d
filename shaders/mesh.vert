#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 clip_from_view;
uniform mat4 view_from_local;
uniform float perspective;  // 1 or 0
out vec3 normal_view;
out vec3 to_eye_view;
out vec4 shade;

void main() {
  vec4 view = view_from_local * vec4(position, 1.0);
  normal_view = mat3(view_from_local) * normal;
  to_eye_view = mix(vec3(0.0, 0.0, 1.0), -view.xyz, perspective);
  shade = colour;
  gl_Position = clip_from_view * view;
}

#version 330 core
uniform vec3 top;
uniform vec3 bottom;
in float height;
out vec4 fragment;

void main() { fragment = vec4(mix(bottom, top, height), 1.0); }

#version 330 core
// One instance is one segment, start to end, as a rectangle around its antialiased capsule. The points before and after
// tell where its share of a joint ends; equal to start or end they mean that there is none.
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 start;
layout(location = 2) in vec3 end;
layout(location = 3) in vec3 after;
layout(location = 4) in vec4 colour;
layout(location = 5) in float width;  // px; 0: not a segment
uniform mat4 clip_from_view;
uniform mat4 view_from_local;
uniform vec2 viewport;     // px
uniform float near_depth;  // m
uniform vec2 pull;         // factor and offset (m) of view z that bring lines before the surface they lie on
flat out vec2 a;           // px from the lower left corner of the viewport
flat out vec2 b;
flat out vec2 split_a;     // normals, into the segment's neighbour, of the lines through a and b that halve the joints
flat out vec2 split_b;
flat out vec4 shade;
flat out float radius;     // px

vec3 to_view(vec3 point) { return (view_from_local * vec4(point, 1.0)).xyz; }

// The point itself, or where the segment towards `other` comes out of the near plane.
vec3 before_eye(vec3 point, vec3 other) {
  float limit = -1.0001 * near_depth;
  return point.z <= limit ? point : mix(point, other, (limit - point.z) / (other.z - point.z));
}

vec3 to_ndc(vec3 view) {
  vec4 clip = clip_from_view * vec4(view, 1.0);
  return clip.xyz / clip.w;
}

vec2 to_pixel(vec3 view) { return (0.5 * to_ndc(view).xy + 0.5) * viewport; }

float depth_of(vec3 view) { return to_ndc(vec3(view.xy, min(view.z * pull.x + pull.y, -near_depth))).z; }

vec2 direction(vec2 from, vec2 to) {
  vec2 step = to - from;
  float length_squared = dot(step, step);
  return length_squared > 1e-8 ? step * inversesqrt(length_squared) : vec2(0.0);
}

void main() {
  vec3 views[4] = vec3[4](to_view(before), to_view(start), to_view(end), to_view(after));
  bool behind = max(-views[1].z, -views[2].z) <= near_depth;
  if (width <= 0.0 || behind) {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  vec3 view_a = before_eye(views[1], views[2]);
  vec3 view_b = before_eye(views[2], views[1]);
  a = to_pixel(view_a);
  b = to_pixel(view_b);
  vec2 along = direction(a, b);
  vec2 into_a = before == start || -views[0].z <= near_depth ? vec2(0.0) : direction(to_pixel(views[0]), a);
  vec2 out_of_b = after == end || -views[3].z <= near_depth ? vec2(0.0) : direction(b, to_pixel(views[3]));
  split_a = into_a == vec2(0.0) ? vec2(0.0) : -(into_a + along);
  split_b = out_of_b == vec2(0.0) ? vec2(0.0) : out_of_b + along;

  radius = 0.5 * max(width, 1.0);
  shade = vec4(colour.rgb, colour.a * min(width, 1.0));
  float reach = radius + 1.0;
  bool at_end = gl_VertexID % 2 == 1;
  float side = gl_VertexID / 2 == 1 ? 1.0 : -1.0;
  vec2 forward = along == vec2(0.0) ? vec2(1.0, 0.0) : along;
  vec2 corner = (at_end ? b + reach * forward : a - reach * forward) + side * reach * vec2(-forward.y, forward.x);
  gl_Position = vec4(2.0 * corner / viewport - 1.0, depth_of(at_end ? view_b : view_a), 1.0);
}

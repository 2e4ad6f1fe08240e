// One triangle that covers the picture; no vertex buffer.
uniform float plane;  // in [-1, 1], against the classes of classify.frag.glsl
out vec2 picture;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  picture = corner;
  gl_Position = vec4(corner, plane, 1.0);
}

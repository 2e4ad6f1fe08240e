// Land and seabed in the picture of the geometry: see surface_grid.frag.glsl. The depth is the sea's,
// logarithmic, but for each pixel: these triangles are large.
in vec3 offset_eye;
in float depth;
out vec4 surface;

void main() {
  surface = vec4(0.0, 0.0, min(length(offset_eye), 60000.0), -1.0);
  gl_FragDepth = log_depth(depth);
}

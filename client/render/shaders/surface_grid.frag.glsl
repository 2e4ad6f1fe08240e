in vec2 undisplaced;
in vec3 offset_eye;
// Undisplaced x, y; distance [m], negative when seen from below; stretch of the pixel on the water:
// its longest side over what it would be on a face turned to the eye, at least 1. 0: no water.
out vec4 surface;

void main() {
  float distance = length(offset_eye);
  vec2 dx = dFdx(undisplaced), dy = dFdy(undisplaced);
  float longest = sqrt(max(dot(dx, dx), dot(dy, dy)));
  float stretch = clamp(longest / (distance * ray_forward.w), 1.0, 64.0);
  // Far away only folded triangles of the lattice turn their backs to an eye in the air.
  bool below = !gl_FrontFacing && (eye.z < 0.0 || distance < 40.0);
  surface = vec4(undisplaced, below ? -distance : distance, stretch);
}

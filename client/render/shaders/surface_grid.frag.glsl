in vec2 displacement;
in vec3 offset_eye;
// Horizontal displacement x, y [m]; distance [m], negative when seen from below; stretch of the pixel
// on the water: its longest side over what it would be on a face turned to the eye, at least 1, or 0
// without water. Half floats do: the undisplaced point is the ray times the distance less the
// displacement, so an error of 2^-12 is a quarter of a pixel, along the view.
out vec4 surface;

void main() {
  float distance = length(offset_eye);
  vec2 undisplaced = offset_eye.xy - displacement;
  vec2 dx = dFdx(undisplaced), dy = dFdy(undisplaced);
  float longest = sqrt(max(dot(dx, dx), dot(dy, dy)));
  float stretch = clamp(longest / (distance * ray_forward.w), 1.0, 64.0);
  // Far away only folded triangles of the lattice turn their backs to an eye in the air.
  bool below = !gl_FrontFacing && (eye.z < 0.0 || distance < 40.0);
  distance = min(distance, 60000.0);
  surface = vec4(displacement, below ? -distance : distance, stretch);
}

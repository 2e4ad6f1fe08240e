in vec2 undisplaced;
in vec3 offset_eye;
out vec4 surface;  // undisplaced x, y; distance [m], negative when seen from below; 1

void main() {
  surface = vec4(undisplaced, (gl_FrontFacing ? 1.0 : -1.0) * length(offset_eye), 1.0);
}

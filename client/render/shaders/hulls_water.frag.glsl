flat in vec4 plane;
out vec4 result;

void main() { result = plane; }

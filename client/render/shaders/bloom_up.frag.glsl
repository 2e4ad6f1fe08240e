// The glow of all sizes in one small picture, so that the full-size pass fetches once.
uniform sampler2D glow0;
uniform sampler2D glow1;
uniform sampler2D glow2;
in vec2 picture;
out vec3 result;

void main() {
  vec2 at = 0.5 * picture + 0.5;
  result = 0.45 * texture(glow0, at).rgb + 0.33 * texture(glow1, at).rgb + 0.22 * texture(glow2, at).rgb;
}

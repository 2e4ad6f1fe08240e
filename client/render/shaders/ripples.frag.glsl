// A periodic tile of cosmetic ripples: capillary-gravity waves shorter than the last cascade.
// xy of a wave: whole turns per tile, z: slope amplitude, w: phase now.
uniform vec4 waves[48];
in vec2 picture;
out vec2 slope;

void main() {
  vec2 at = (0.5 * picture + 0.5) * 6.28318531;
  vec2 sum = vec2(0.0);
  for (int n = 0; n < 48; ++n) {
    vec4 wave = waves[n];
    sum += normalize(wave.xy) * (wave.z * cos(dot(wave.xy, at) + wave.w));
  }
  slope = sum;
}

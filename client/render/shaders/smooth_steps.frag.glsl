// Smooths stairs along steps in distance, for pictures of one sample per pixel: where a stair's tread
// begins and ends tells where the true edge crosses each pixel, and so what share of the pixel belongs
// to the neighbour behind it (morphological antialiasing, Reshetov 2009; on distances, not colours).
uniform sampler2D scene;
out vec4 radiance;

const int kReach = 32;

// The share of a pixel, 0 to 0.5, that the edge cuts off if the tread ends `n` pixels away with the
// neighbour's sheet coming in; `middle` is half the tread's length.
float cut_by(float n, float middle) {
  float from = min(n - 1.0, middle), to = min(n, middle);
  return 0.5 * ((to - from) - 0.5 * (to * to - from * from) / middle);
}

// Follows the step between the row of `pixel` and the one `across` it. x: pixels to its end,
// y: 1 if there the sheet of the row across comes into this row.
vec2 end_of_tread(ivec2 pixel, ivec2 across, ivec2 along, float self, float other) {
  vec2 end = vec2(float(kReach), 0.0);
  // Half as high is no more this step: near the horizon all rows lie far behind each other.
  float lowest = 0.5 * abs(self - other);
  for (int n = 1; n <= kReach; ++n) {
    pixel += along;
    float a = depth_at(pixel), b = depth_at(pixel + across);
    if (abs(a - b) < lowest) {
      end = vec2(float(n), abs(a - other) < abs(a - self) ? 1.0 : 0.0);
      break;
    }
    self = a;
    other = b;
  }
  return end;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float self = depth_at(pixel);
  ivec2 across = upwards(), along = across.yx;
  float other = depth_at(pixel + across), below = depth_at(pixel - across);
  if (abs(below - self) > abs(other - self)) {
    across = -across;
    other = below;
  }
  vec2 before = end_of_tread(pixel, across, -along, self, other);
  vec2 after = end_of_tread(pixel, across, along, self, other);
  float middle = 0.5 * (before.x + after.x - 1.0);
  float share = before.y * cut_by(before.x, middle) + after.y * cut_by(after.x, middle);
  radiance = mix(texelFetch(scene, pixel, 0), texelFetch(scene, inside(pixel + across), 0), share);
}

// What stands in the sea, cut off where the sea or land stands before it. SAMPLES: of the geometry pass.
#if SAMPLES > 1
uniform sampler2DMS surface_map;
#else
uniform sampler2D depth_map;
#endif

// Share of the pixel that stands before the sea: hard at crests, soft along the waterline, where the
// distance to the sea passes its own within a pixel or two.
float before_sea(float distance, float depth, float below_eye_m) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  // How much farther the flat sea is one pixel higher up.
  float pixel_m = distance * ray_forward.w;
  float soft = pixel_m * clamp(distance / max(abs(below_eye_m), 0.3), 1.0, 40.0);
#if SAMPLES > 1
  float share = 0.0;
  for (int n = 0; n < SAMPLES; ++n) {
    vec4 s = texelFetch(surface_map, pixel, n);
    float sea = s.w != 0.0 ? abs(s.z) : 1e6;  // or land
    share += clamp(0.5 + (sea - distance) / soft, 0.0, 1.0);
  }
  return share / float(SAMPLES);
#else
  float there = texelFetch(depth_map, pixel, 0).r;
  float sea = there < 1.0 ? depth_of(there) : 1e6;
  return clamp(0.5 + (sea * distance / depth - distance) / soft, 0.0, 1.0);
#endif
}

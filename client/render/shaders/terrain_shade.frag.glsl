// Light from land and seabed towards the eye, for every pixel that they cover.
#if SAMPLES > 1
uniform sampler2DMS surface_map;
#else
uniform sampler2D surface_map;
#endif
in vec2 picture;
out vec4 radiance;

vec3 shade(float distance, vec3 direction) {
  vec2 xy = direction.xy * distance;
  // The pixel on the ground, between its length and its breadth.
  float footprint = log2(distance * ray_forward.w);
  vec4 ground = ground_at(xy, max(footprint - ground_noise.z, 0.0));
  footprint += 0.6 * log2(clamp(sqrt(1.0 + dot(ground.yz, ground.yz)) / max(-dot(direction, vec3(-ground.yz, 1.0)), 0.02), 1.0, 40.0));
  Ground g = ground_of(xy, ground, footprint);
  if (eye.z < 0.0) {
    vec3 light = bottom_irradiance.rgb * (1.0 / 0.54) * exp(water_kd.rgb * min(ground.x, 0.0));
    return mix(water_body(direction), g.albedo * light * max(g.normal.z, 0.0), water_passed(distance));
  }
  return through_air(ground_light(g, direction), direction, distance);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 direction = picture_ray(picture);
#if SAMPLES > 1
  float share = 0.0, distance = 0.0;
  for (int n = 0; n < SAMPLES; ++n) {
    vec4 s = texelFetch(surface_map, pixel, n);
    float land = s.w < -0.5 ? 1.0 / float(SAMPLES) : 0.0;
    share += land;
    distance += land * s.z;
  }
  if (share <= 0.0) discard;
  radiance = vec4(shade(distance / share, direction) * share, share);
#else
  vec4 s = texelFetch(surface_map, pixel, 0);
  if (s.w > -0.5) discard;
  radiance = vec4(shade(s.z, direction), 1.0);
#endif
}

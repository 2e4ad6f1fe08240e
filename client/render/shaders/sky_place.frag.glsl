// The sky where no water covers it, from its small picture; with SUN only the sun's disc, which is
// sharp, to be added.
uniform sampler2D small_sky;
in vec2 picture;
out vec4 radiance;

#if SUN
vec3 sun_disc(vec3 direction) {
  // Small angles: the chord is the angle. The edge is a pixel wide.
  float angle = length(direction - sun_direction.xyz);
  float radius = max(0.00465, 1.2 * ray_forward.w);
  float inside = 1.0 - smoothstep(radius - ray_forward.w, radius + ray_forward.w, angle);
  float limb = sqrt(max(0.1, 1.0 - angle * angle / (radius * radius)));
  return inside * min(sun_irradiance.rgb / (kPi * 0.00465 * 0.00465) * limb, vec3(3000.0));
}
#endif

void main() {
  vec4 sky = textureLod(small_sky, 0.5 * picture + 0.5, 0.0);
#if SUN
  radiance = vec4(sun_disc(picture_ray(picture)) * sky.a, 0.0);
#else
  radiance = vec4(min(sky.rgb, vec3(57000.0)), 1.0);
#endif
}

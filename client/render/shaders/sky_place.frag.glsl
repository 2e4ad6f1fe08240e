// The sky where no water covers it, from its small picture, and the sun's disc, which is sharp.
uniform sampler2D small_sky;
in vec2 picture;
out vec4 radiance;

vec3 sun_disc(vec3 direction) {
  // Small angles: the chord is the angle. The edge is a pixel wide.
  float angle = length(direction - sun_direction.xyz);
  float radius = max(0.00465, 1.2 * ray_forward.w);
  float inside = 1.0 - smoothstep(radius - ray_forward.w, radius + ray_forward.w, angle);
  float limb = sqrt(max(0.1, 1.0 - angle * angle / (radius * radius)));
  return inside * min(sun_irradiance.rgb / (kPi * 0.00465 * 0.00465) * limb, vec3(3000.0));
}

void main() {
  vec4 sky = textureLod(small_sky, 0.5 * picture + 0.5, 0.0);
  vec3 colour = sky.rgb + sun_disc(picture_ray(picture)) * sky.a;
  radiance = vec4(min(colour, vec3(60000.0)), 1.0);
}

// The sky where no water covers it: clear air, a thin layer of broken clouds, the sun's disc.
uniform sampler2D cloud_map;
in vec2 picture;
out vec4 radiance;

const float kCloudHeight = 2100.0;

float cloud_density(vec2 at, float threshold) {
  vec2 drift = vec2(foam_irradiance.w);
  float large = textureLod(cloud_map, at * 0.37 + drift, 0.0).r;
  float middle = textureLod(cloud_map, at * 1.9 - drift.yx, 0.0).r;
  float fine = textureLod(cloud_map, at * 7.3, 0.0).r;
  return large * 0.60 + middle * 0.28 + fine * 0.12 - threshold;
}

vec4 clouds(vec3 direction) {
  float cover = sky_irradiance.w;
  // Distance to a layer above a round sea.
  float d = kEarthRadius * direction.z;
  float along = sqrt(d * d + 2.0 * kEarthRadius * kCloudHeight) - d;
  vec2 at = direction.xy * along * cloud_radiance.w;
  float threshold = mix(0.80, 0.18, pow(cover, 0.8));
  float density = cloud_density(at, threshold);
  float far = exp(-along / 45000.0);
  float opacity = smoothstep(0.0, mix(0.16, 0.35, cover), density) * far;
  if (opacity <= 0.001) return vec4(0.0);
  // Lit from the sun's side: thinner towards the sun means brighter.
  vec2 toward = normalize(sun_direction.xy + 1e-4) * 0.012;
  float shade = clamp(cloud_density(at + toward, threshold) * 3.5, 0.0, 1.0);
  float cosine = dot(direction, sun_direction.xyz);
  float silver = pow(max(0.0, 0.5 + 0.5 * cosine), 12.0) * (1.0 - clamp(density * 4.0, 0.0, 1.0));
  vec3 lit = sun_irradiance.rgb * (0.07 * (1.0 - 0.65 * shade) + 0.35 * silver);
  vec3 colour = cloud_radiance.rgb * mix(1.0, 0.62, shade * (0.4 + 0.6 * cover)) + lit * (1.0 - cover);
  return vec4(mix(sky_at(direction, 0.1), colour, far), opacity);
}

vec3 sun_disc(vec3 direction) {
  // The disc's edge is a pixel wide; limb darkening by (1 - r²)^0.25.
  float angle = 2.0 * asin(min(0.5 * length(direction - sun_direction.xyz), 1.0));
  float radius = max(0.00465, 1.2 * ray_forward.w);
  float inside = 1.0 - smoothstep(radius - ray_forward.w, radius + ray_forward.w, angle);
  float limb = pow(max(0.02, 1.0 - angle * angle / (radius * radius)), 0.25);
  return inside * min(sun_irradiance.rgb / (kPi * 0.00465 * 0.00465) * limb, vec3(3000.0));
}

void main() {
  vec3 direction = picture_ray(picture);
  vec3 colour = vec3(0.0);
  // Below the horizon's dip there is only water. A loop that runs once stands for a branch that
  // software rasterisers really skip (see surface.frag.glsl).
  float dip = 0.02 + 2.0 * sqrt(max(eye.z, 0.0) / kEarthRadius);
  for (int seen = direction.z > -dip || eye.z < 1.0 ? 1 : 0; seen > 0; --seen) {
    vec4 cloud = clouds(vec3(direction.xy, max(direction.z, 0.003)));
    colour = sky_at(direction, 0.0) + sun_disc(direction);
    colour = min(mix(colour, cloud.rgb, cloud.a), vec3(60000.0));
  }
  radiance = vec4(colour, 1.0);
}

// Clear air and a thin layer of broken clouds, in fewer pixels than the picture has: nothing in them is sharp.
// Alpha is what the clouds let through.
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
  float far = exp(-along * (1.0 / 45000.0));
  float opacity = smoothstep(0.0, mix(0.16, 0.35, cover), density) * far;
  // Lit from the sun's side: thinner towards the sun means brighter.
  vec2 toward = normalize(sun_direction.xy + 1e-4) * 0.012;
  float shade = clamp((textureLod(cloud_map, (at + toward) * 1.9, 0.0).r * 0.5 + density) * 2.2 - 0.9, 0.0, 1.0);
  float bright = 0.5 + 0.5 * dot(direction, sun_direction.xyz);
  bright *= bright * bright;
  bright *= bright;
  float silver = bright * bright * (1.0 - clamp(density * 4.0, 0.0, 1.0));
  vec3 lit = sun_irradiance.rgb * (0.07 * (1.0 - 0.65 * shade) + 0.35 * silver);
  vec3 colour = cloud_radiance.rgb * mix(1.0, 0.62, shade * (0.4 + 0.6 * cover)) + lit * (1.0 - cover);
  return vec4(mix(sky_at(direction, 0.1), colour, far), opacity);
}

void main() {
  vec3 direction = picture_ray(picture);
  vec4 cloud = clouds(vec3(direction.xy, max(direction.z, 0.003)));
  radiance = vec4(mix(sky_at(direction, 0.0), cloud.rgb, cloud.a), 1.0 - cloud.a);
}

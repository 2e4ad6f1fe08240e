// One edge of a rope: a ribbon along its line that faces the eye, half a pixel wider than the rope on
// either side. A rope of less than 1.2 pixels is drawn as wide, and fainter.
layout(location = 0) in vec4 place_along;     // relative to the eye's place on the water [m]; along the rope [m]
layout(location = 1) in vec4 tangent_radius;  // unit; [m]
out vec3 offset_eye;
out vec3 side;         // unit, across the ribbon
out vec3 tangent;
out vec3 across_along; // pixels from the middle; metres along the rope; its radius [m]
out vec2 half_faint;   // half its width [pixels]; its share of what is drawn
out float depth;       // along the view [m]

void main() {
  vec3 world = place_along.xyz;
  world.z -= dot(world.xy, world.xy) / (2.0 * kEarthRadius);
  vec3 to = world - eye.xyz;
  float pixel_m = max(dot(to, ray_forward.xyz), 0.1) * ray_forward.w;
  tangent = tangent_radius.xyz;
  vec3 across = cross(tangent, to);
  // Seen end on: any way across.
  side = dot(across, across) > 1e-9 * dot(to, to) ? normalize(across) : normalize(cross(to, vec3(0.3, 0.2, 1.0)));
  float radius = tangent_radius.w;
  float half_m = max(radius, 0.6 * pixel_m);
  float edge = float(gl_VertexID & 1) * 2.0 - 1.0;
  world += side * (edge * (half_m + 0.5 * pixel_m));
  offset_eye = world - eye.xyz;
  across_along = vec3(edge * (half_m / pixel_m + 0.5), place_along.w, radius);
  half_faint = vec2(half_m / pixel_m, radius / half_m);
  gl_Position = clip_from_world * vec4(world, 1.0);
  depth = gl_Position.w;
  gl_Position.z = -kNearest;
}

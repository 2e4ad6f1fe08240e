// Places a vertex of the log-polar lattice on the displaced sea.
uniform sampler2DArray displacement_map;
uniform sampler2DArray patch_height_map;
out vec2 displacement;  // horizontal [m]
out vec3 offset_eye;    // surface point less the eye [m]

void main() {
  int columns = int(grid.x);
  int row = gl_VertexID / columns, column = gl_VertexID - row * columns;
  float azimuth = grid.y + float(column) * grid.z;
  float radius = exp(grid_rows.x + float(row) * grid.w);
  if (row == 0 && grid_rows.y > 0.5) radius = 0.0;
  vec2 xy = radius * vec2(cos(azimuth), sin(azimuth));

  // Waves that the lattice can't carry are left to the shading: mips by the spacing of vertices.
  float across = radius * grid.z, along = radius * grid.w;
  float spacing = 0.5 * log2(max(across * along, 1e-6));
  vec3 moved = vec3(0.0);
  int cascades = int(counts.x);
#if ATTENUATED
  vec4 factors = wave_factors(xy, 0);
#endif
  for (int c = 0; c < cascades; ++c) {
    float lod = max(spacing - cascade_map[c].w, 0.0) + 0.8;
    if (lod > 6.0) break;  // cascades grow finer: the rest averages to nothing here
    vec3 wave = textureLod(displacement_map, vec3(tile_coordinate(c, xy), float(c)), lod).xyz;
#if ATTENUATED
    if (c == 4) factors = wave_factors(xy, 1);
    wave *= factors[c & 3];
#endif
    moved += wave;
  }
#if ATTENUATED
  float regular_factor = wave_factors(xy, cascades / 4)[cascades & 3];
#else
  const float regular_factor = 1.0;
#endif
  moved = with_regular_waves(moved, xy, regular_factor);

  displacement = moved.xy;
  vec2 flat_xy = xy + moved.xy;
  int patches = int(counts.w);
  for (int n = 0; n < patches; ++n) {
    float lod = max(spacing - patch_cell[n].x, 0.0);
    moved.z += textureLod(patch_height_map, patch_coordinate(n, flat_xy), lod).r;
  }
  float drop = dot(flat_xy, flat_xy) / (2.0 * kEarthRadius);
  vec3 world = vec3(flat_xy, moved.z - drop);
  offset_eye = world - eye.xyz;
  gl_Position = clip_from_world * vec4(world, 1.0);
  float w = gl_Position.w;
  gl_Position.z = (2.0 * log_depth(w) - 1.0) * w;
}

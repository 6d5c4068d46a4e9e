% A tread block as a Winkler foundation: octave-cli winkler.m CASE.json HISTORY.csv
% Independent columns of the instantaneous modulus, shear modulus a third of it, static friction at their ends.
arguments = argv();
c = jsondecode(fileread(arguments{1}));
modulus = c.compound.long_term_modulus_Pa + sum([c.compound.terms.modulus_Pa]);
friction = c.friction.static_coefficient;
times = 600;
columns = 200;

t = linspace(0, 1.02 * c.expected_duration_s, times + 1);
cell_length = c.block.columns.s_m(end) / columns;
s = ((0:columns - 1) + 0.5) * cell_length;
height = interp1(c.block.columns.s_m, c.block.columns.height_m, s);
offset = interp1(c.block.columns.s_m, c.block.columns.arc_offset_m, s);
% interp1 wants places that differ: a jump of the width becomes a step over 1e-12 m
place = c.block.width_profile.s_m(:)' + 1e-12 * (0:numel(c.block.width_profile.s_m) - 1);
area = cell_length * interp1(place, c.block.width_profile.width_m, s, "linear", 0);

road = c.road;
samples = c.path.samples;
normal = zeros(1, times + 1);
tangential = zeros(1, times + 1);
shear = zeros(1, columns);
before = zeros(1, columns);
for row = 1:times + 1
  arc = c.path.first_contact_arc_m + c.path.arc_speed_m_s * t(row) - offset;
  slope = interp1(samples.arc_m, samples.slope_rad, arc);
  x = interp1(samples.arc_m, samples.x_m, arc) + height .* sin(slope);
  y = interp1(samples.arc_m, samples.y_m, arc) - height .* cos(slope);
  if isempty(road.radius_m)
    depth = -y;
  else
    depth = road.radius_m - hypot(x, y + road.radius_m);
  end
  pressure = modulus * max(depth, 0) ./ height;
  if row > 1
    shear = shear + (road.surface_speed_m_s * t(2) - (x - before)) * modulus / 3 ./ height;
  end
  shear = max(-friction * pressure, min(friction * pressure, shear)) .* (depth > 0);
  before = x;
  normal(row) = sum(pressure .* area);
  tangential(row) = -sum(shear .* area);
end

out = fopen(arguments{2}, "w");
fprintf(out, "# case_digest: %s\n", c.case_digest);
fprintf(out, "time_s,normal_force_N,tangential_force_N\n");
fprintf(out, "%.12g,%.12g,%.12g\n", [t; normal; tangential]);
fclose(out);

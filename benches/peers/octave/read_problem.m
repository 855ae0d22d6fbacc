% The bearing's numbers, SI units. State y = [q; dq/dt], q = [r of every roller; theta; phi; x, y, theta of each cage;
% inner x, y; outer x, y]; roller j of row i (from 0) has index i * rollers + j.
function p = read_problem (path)
  file = fopen (path, "r");
  lines = textscan (file, "%s %s");
  fclose (file);
  p = cell2struct (num2cell (str2double (lines{2})), lines{1}, 1);  % textscan's own numbers miss the last digit
  p.total = p.rows * p.rollers;
  p.dof = 3 * p.total + 3 * p.rows + 4;
  p.inner_radius = p.inner_raceway_diameter / 2;
  p.outer_radius = p.outer_raceway_diameter / 2;
  p.roller_inertia = 0.5 * p.roller_mass * p.roller_radius^2;
  p.cage_inertia = 0.5 * p.cage_mass * (p.cage_inner_radius^2 + p.cage_outer_radius^2);
  p.intact_share = ((p.roller_length - p.defect_width) / p.roller_length) ^ (8 / 9);
  p.alpha = 2 * pi * (0:p.rollers-1)' / p.rollers + p.stagger * (0:p.rows-1);  % a column for each row of rollers

  % What a length of 1 on a surface is in each coordinate.
  p.lever = ones (p.dof, 1);
  p.lever(p.total+1:2*p.total) = p.pitch_radius;
  p.lever(2*p.total+1:3*p.total) = p.roller_radius;
  p.lever(3*p.total+3:3:3*p.total+3*p.rows) = p.pitch_radius;

  % Pure rolling, cages centred, both rings 1 um aside in x and y and at rest.
  n = p.total;
  orbit = p.speed * p.inner_radius / (2 * p.pitch_radius);
  q = v = zeros (p.dof, 1);
  q(n+1:2*n) = p.alpha(:);
  q(end-3:end) = 1e-6;
  v(n+1:2*n) = orbit;
  v(2*n+1:3*n) = -(p.speed * p.inner_radius - p.pitch_radius * orbit) / p.roller_radius;
  v(3*n+3:3:3*n+3*p.rows) = orbit;
  p.start = [q; v];
end

% The equations of motion, vectorised over the rollers and over both raceways.
function f = make_rhs (p)
  c.n = p.total;
  c.dof = p.dof;
  c.rows = p.rows;
  c.rollers = p.rollers;
  c.gap = [p.clearance, 0];  % raceways along the second dimension: inner, outer
  c.sign = [1, -1];
  c.stiffness = [p.inner_stiffness, p.outer_stiffness];
  c.surface = [p.speed * p.inner_radius, 0];
  c.damaged = ((p.defect_row - 1) * p.rollers + 1 : p.defect_row * p.rollers)';
  c.half_arc = 0.5 * p.defect_length / p.outer_radius;
  c.support_stiffness = [p.support_inner_stiffness, p.support_outer_stiffness];
  c.support_damping = [p.support_inner_damping, p.support_outer_damping];
  c.ring_mass = [p.inner_mass, p.outer_mass];
  c.load = [0, p.load_x; 0, p.load_y];
  c.film = p.viscosity * p.guide_width^3 / p.guide_clearance^2;
  c.twist = 2 * pi * p.viscosity * p.cage_outer_radius^2 * p.guide_width / p.guide_clearance;
  f = @(t, y) rhs (t, y, p, c);
end

function dy = rhs (t, y, p, c)
  n = c.n;
  dof = c.dof;
  Rm = p.pitch_radius;
  rr = p.roller_radius;
  v = y(dof+1:end);
  r = y(1:n);
  theta = y(n+1:2*n);
  cage = reshape (y(3*n+1:dof-4), 3, c.rows);
  ring = reshape (y(dof-3:dof), 2, 2);  % a column for each ring
  dr = v(1:n);
  dtheta = v(n+1:2*n);
  dphi = v(2*n+1:3*n);
  dcage = reshape (v(3*n+1:dof-4), 3, c.rows);
  dring = reshape (v(dof-3:dof), 2, 2);
  ex = cos (theta);
  ey = sin (theta);
  along = [ex, ey];
  across = [-ey, ex];

  % Normal contacts, friction.
  delta = c.sign .* (along * ring - r) - c.gap;
  power = max (delta, 0) .^ p.exponent;
  u = abs (mod (theta(c.damaged) - p.defect_angle + pi, 2 * pi) - pi);
  on = c.damaged(u <= c.half_arc);
  if (! isempty (on))
    rest = max (delta(on,2) - p.defect_depth, 0) .^ p.exponent;
    power(on,2) = p.intact_share * power(on,2) + (1 - p.intact_share) * rest;
  end
  rate = c.sign .* (along * dring + dtheta .* (across * ring) - dr);
  Q = (delta > 0) .* max (c.stiffness .* power + p.contact_damping * rate, 0);
  slip = across * dring + c.surface - Rm * dtheta + c.sign .* (rr * dphi);
  f = p.friction * Q .* tanh (slip / p.slip_velocity);
  radial = Q(:,1) - Q(:,2);
  push = f(:,1) + f(:,2);
  moment = rr * (f(:,2) - f(:,1));

  % Pockets: few rollers touch theirs.
  on_cage = zeros (3, c.rows);
  s = Rm * (cage(3,:) + p.alpha - reshape (theta, c.rollers, c.rows)) ...
      + reshape (ex, c.rollers, c.rows) .* cage(2,:) - reshape (ey, c.rollers, c.rows) .* cage(1,:);
  k = find (abs (s(:)) > p.pocket_clearance);
  if (! isempty (k))
    row = ceil (k / c.rollers);
    s = s(k);
    cx = ex(k);
    cy = ey(k);
    xc = cage(1,row)';
    yc = cage(2,row)';
    vxc = dcage(1,row)';
    vyc = dcage(2,row)';
    wc = dcage(3,row)';
    side = sign (s);
    ds = Rm * (wc - dtheta(k)) + cx .* vyc - cy .* vxc - dtheta(k) .* (cx .* xc + cy .* yc);
    size = max (p.cage_stiffness * (abs (s) - p.pocket_clearance) + p.cage_damping * side .* ds, 0);
    sigma = -side .* (size > 0);
    Fc = side .* size;
    u = dr(k) - sigma .* (rr * (dphi(k) - wc)) - (cx .* vxc + cy .* vyc);
    a = abs (u);
    fc = -((-0.1 + 22.28 * a) .* exp (-181.46 * a) + 0.1) .* size .* sign (u);
    radial(k) += fc;
    push(k) += Fc;
    moment(k) -= rr * sigma .* fc;
    for i = 1:numel (k)
      on_cage(:,row(i)) += [Fc(i)*cy(i) - fc(i)*cx(i); -Fc(i)*cx(i) - fc(i)*cy(i); sigma(i)*rr*fc(i) - Fc(i)*Rm];
    end
  end

  % Rollers.
  arm = Rm + r;
  rollers = [radial / p.roller_mass + arm .* dtheta.^2; (push / p.roller_mass - 2 * dr .* dtheta) ./ arm; ...
             moment / p.roller_inertia];

  % Rings.
  F = -(along' * (c.sign .* Q)) - across' * f - c.support_stiffness .* ring - c.support_damping .* dring ...
      - min (t / p.ramp, 1) * c.load;

  % Cages in the outer ring.
  g = cage(1:2,:) - ring(:,2);
  e = sqrt (sum (g.^2, 1));
  eps_ = min (e / p.guide_clearance, 0.95);
  one = 1 - eps_.^2;
  root = sqrt (one);
  normal = g ./ max (e, realmin);
  normal(1, e == 0) = 1;
  ue = p.cage_outer_radius * dcage(3,:);
  Fn = -c.film * abs (ue) .* eps_.^2 ./ one.^2 - p.cage_stiffness * max (e - p.guide_clearance, 0);
  Ft = pi * c.film * ue .* eps_ ./ (4 * one .* root);
  force = Fn .* normal + Ft .* [-normal(2,:); normal(1,:)];
  F(:,2) -= sum (force, 2);
  cages = [(on_cage(1:2,:) + force) / p.cage_mass; (on_cage(3,:) - c.twist * ue ./ root) / p.cage_inertia];

  dy = [v; rollers; cages(:); (F ./ c.ring_mass)(:)];
end

% Octave's solvers on the bearing.
%
%   octave solve.m check PROBLEM STATES       accelerations at every state of a table, then the start
%   octave solve.m ode45|ode15s PROBLEM OUT DURATION RATE LENGTH SPEED RTOL MAX_STEP BUDGET TOL...
%
% Each TOL is a run with absolute tolerances TOL * LENGTH and TOL * SPEED (on a surface) and relative TOL * RTOL, repeated for BUDGET
% seconds at most. The rings' accelerations go to OUT-<number>.f64.
1;

function samples = run (method, p, f, times, atol, rtol, max_step)
  options = odeset ("AbsTol", atol, "RelTol", rtol, "MaxStep", max_step, "InitialStep", 1e-9);
  [t, y] = feval (method, f, times, p.start, options);
  if (numel (t) != numel (times))
    error ("%s stopped at t = %g", method, t(end));
  end
  samples = zeros (4, numel (times));
  for k = 1:numel (times)
    dy = f (times(k), y(k,:)');
    samples(:,k) = dy(end-3:end);
  end
end

args = argv ();
addpath (fileparts (mfilename ("fullpath")));
p = read_problem (args{2});
f = make_rhs (p);
if (strcmp (args{1}, "check"))
  file = fopen (args{3}, "r");
  numbers = fscanf (file, "%f");
  fclose (file);
  for column = reshape (numbers(2:end), 1 + 2 * p.dof, numbers(1))
    dy = f (column(1), column(2:end));
    printf ("%.17g\n", dy(p.dof+1:end));
  end
  printf ("%.17g\n", p.start);
  exit (0);
end
n = cellfun (@str2double, args(4:end));
times = (0:floor (n(1) * n(2) + 1e-6))' / n(2);
f (0, p.start);
for i = 8:numel (n)
  tol = n(i);
  atol = tol * [n(3) ./ p.lever; n(4) ./ p.lever];
  cpu = wall = Inf;
  spent = repeats = 0;
  do
    started = tic ();
    before = cputime ();
    samples = run (args{1}, p, f, times, atol, max (tol * n(5), 1e-15), n(6));
    cpu = min (cpu, cputime () - before);
    took = toc (started);
    wall = min (wall, took);
    spent += took;
    repeats++;
  until (spent + wall >= n(7))
  file = fopen (sprintf ("%s-%d.f64", args{3}, i - 8), "w");
  fwrite (file, samples, "double", 0, "ieee-le");
  fclose (file);
  printf ("{\"tol\": %.6g, \"cpu\": %.6g, \"wall\": %.6g, \"rhs\": null, \"steps\": null, \"repeats\": %d}\n", tol, cpu, wall, repeats);
  fflush (stdout);
end

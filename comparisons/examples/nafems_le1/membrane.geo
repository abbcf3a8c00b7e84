// NAFEMS LE1, elliptic membrane (The Standard NAFEMS Benchmarks, 1990): a quarter of a ring between two ellipses.
lc = 0.25;
Point(1) = {0, 0, 0, lc};
Point(2) = {2, 0, 0, lc / 3}; // D, where the stress is asked for
Point(3) = {3.25, 0, 0, lc};
Point(4) = {0, 2.75, 0, lc};
Point(5) = {0, 1, 0, lc};
Line(1) = {2, 3};
Ellipse(2) = {3, 1, 3, 4};
Line(3) = {4, 5};
Ellipse(4) = {5, 1, 2, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("x_axis") = {1};
Physical Curve("outer") = {2};
Physical Curve("y_axis") = {3};
Physical Curve("inner") = {4};
Physical Surface("membrane") = {1};

// A quarter of a ring between the radii 1 and 2.
lc = 0.2;
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0, lc / 2};
Point(3) = {2, 0, 0, lc};
Point(4) = {0, 2, 0, lc};
Point(5) = {0, 1, 0, lc / 2};
Line(1) = {2, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("x_axis") = {1};
Physical Curve("outer") = {2};
Physical Curve("y_axis") = {3};
Physical Curve("inner") = {4};
Physical Surface("cylinder") = {1};

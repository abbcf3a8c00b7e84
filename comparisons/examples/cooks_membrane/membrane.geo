// Cook's membrane (Cook 1974), in the units of the original: lengths without unit are taken as metres.
lc = 4;
Point(1) = {0, 0, 0, lc};
Point(2) = {48, 44, 0, lc};
Point(3) = {48, 60, 0, lc};
Point(4) = {0, 44, 0, lc / 4}; // the obtuse corner at the support, where the stress is singular
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("clamp") = {4};
Physical Curve("end") = {2};
Physical Curve("sides") = {1, 3};
Physical Surface("membrane") = {1};

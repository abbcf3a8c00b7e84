// A bracket of 120 by 60 mm with three holes, steel to the left of x = 60 mm and aluminium to the right.
mm = 0.001;
lc = 8 * mm;
fine = 3 * mm;
Point(1) = {0, 0, 0, lc};
Point(2) = {60 * mm, 0, 0, lc};
Point(3) = {120 * mm, 15 * mm, 0, lc};
Point(4) = {120 * mm, 45 * mm, 0, lc};
Point(5) = {60 * mm, 60 * mm, 0, lc};
Point(6) = {0, 60 * mm, 0, lc};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5}; // between the materials
// A round hole at (x, y) of radius r; its curve loop is `hole`, its curves are `arcs`.
Macro RoundHole
  p = newp;
  Point(p) = {x, y, 0};
  Point(p + 1) = {x + r, y, 0, fine};
  Point(p + 2) = {x, y + r, 0, fine};
  Point(p + 3) = {x - r, y, 0, fine};
  Point(p + 4) = {x, y - r, 0, fine};
  c = newreg;
  Circle(c) = {p + 1, p, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4};
  Circle(c + 3) = {p + 4, p, p + 1};
  arcs[] = {c, c + 1, c + 2, c + 3};
  hole = newreg;
  Curve Loop(hole) = arcs[];
Return
x = 20 * mm; y = 15 * mm; r = 6 * mm;
Call RoundHole;
lower = hole; lower_arcs[] = arcs[];
y = 45 * mm;
Call RoundHole;
upper = hole; upper_arcs[] = arcs[];
x = 90 * mm; y = 30 * mm; r = 9 * mm;
Call RoundHole;
right = hole; right_arcs[] = arcs[];
steel = newreg;
Curve Loop(steel) = {1, 7, 5, 6};
aluminium = newreg;
Curve Loop(aluminium) = {2, 3, 4, -7};
Plane Surface(1) = {steel, lower, upper};
Plane Surface(2) = {aluminium, right};
Physical Curve("bolts") = {lower_arcs[], upper_arcs[]};
Physical Curve("eye") = {right_arcs[]};
Physical Curve("lip") = {3};
Physical Curve("outside") = {1, 2, 4, 5, 6};
Physical Surface("steel") = {1};
Physical Surface("aluminium") = {2};

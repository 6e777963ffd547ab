// SPDX-License-Identifier: BSD-3-Clause
// A closed box, 1.2 x 0.7 x 0.5 m, its top of quadrilaterals.
SetFactory("Built-in");
h = 0.6;
Point(1) = {-0.6, -0.35, 0, h}; Point(2) = {0.6, -0.35, 0, h}; Point(3) = {0.6, 0.35, 0, h}; Point(4) = {-0.6, 0.35, 0, h};
Point(5) = {-0.6, -0.35, 0.5, h}; Point(6) = {0.6, -0.35, 0.5, h}; Point(7) = {0.6, 0.35, 0.5, h}; Point(8) = {-0.6, 0.35, 0.5, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Line(9) = {1, 5}; Line(10) = {2, 6}; Line(11) = {3, 7}; Line(12) = {4, 8};
Curve Loop(1) = {-4, -3, -2, -1}; Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Curve Loop(3) = {1, 10, -5, -9}; Plane Surface(3) = {3};
Curve Loop(4) = {2, 11, -6, -10}; Plane Surface(4) = {4};
Curve Loop(5) = {3, 12, -7, -11}; Plane Surface(5) = {5};
Curve Loop(6) = {4, 9, -8, -12}; Plane Surface(6) = {6};
Transfinite Surface {2}; Recombine Surface {2};
Physical Surface("hull", 7) = {1, 3, 4, 5, 6};
Physical Surface("deck plate", 9) = {2};

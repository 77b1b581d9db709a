// SPDX-License-Identifier: BSL-1.0
// The study's layer as a Delaunay triangulation: gmsh -2 unstructured.geo -format msh22
// Edges of 1.9 m above and beside the fault, twice that at the far sides.
// Others by -setnumber fine 1.2 -setnumber algorithm 6 (frontal).
DefineConstant[ fine = 1.9, algorithm = 5 ];
Point(1) = {-52, 0, 0};
Point(2) = {0, 0, 0};  // the fault's tip
Point(3) = {23, 0, 0};
Point(4) = {23, 25, 0};
Point(5) = {-52, 25, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1, 2};
Physical Curve("right") = {3};
Physical Curve("surface") = {4};
Physical Curve("left") = {5};
Physical Surface("soil") = {1};
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (1 + Max(-20 - x, 0) / 32 + Max(x - 5, 0) / 18)", fine);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = algorithm;

// SPDX-License-Identifier: BSL-1.0
// Twenty metres of soil over a fault at (0, 0), unstructured 8-node quadrilaterals:
// gmsh -2 own_ground.geo -format msh41
// Sides of 2 m above the tip and where a reverse fault may come out, 4 m far away.
Point(1) = {-45, 0, 0};
Point(2) = {0, 0, 0};  // the fault's tip
Point(3) = {25, 0, 0};
Point(4) = {25, 20, 0};
Point(5) = {-45, 20, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Recombine Surface {1};
Physical Curve("bottom") = {1, 2};
Physical Curve("right") = {3};
Physical Curve("surface") = {4};
Physical Curve("left") = {5};
Physical Surface("soil") = {1};
Field[1] = MathEval;
Field[1].F = "2 * (1 + Max(-28 - x, 0) / 17 + Max(x - 5, 0) / 20)";
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm = 6;  // frontal
Mesh.RecombinationAlgorithm = 3;  // all quadrilaterals: meshed twice as coarse, then divided
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;

// A rectangle of 4 x 2 with a round hole of radius 0.5 about (3, 1), two regions, second order.
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 2};
Rectangle(2) = {2, 0, 0, 2, 2};
Disk(3) = {3, 1, 0, 0.5};
BooleanDifference(4) = { Surface{2}; Delete; }{ Surface{3}; Delete; };
BooleanFragments{ Surface{1}; Delete; }{ Surface{4}; Delete; }
bottom() = Curve In BoundingBox {-0.1, -0.1, -0.1, 4.1, 0.1, 0.1};
hole() = Curve In BoundingBox {2.4, 0.4, -0.1, 3.6, 1.6, 0.1};
Physical Surface("soft sand", 7) = {1};
Physical Surface("rock", 3) = {4};
Physical Curve("bottom", 5) = bottom();
Physical Curve("hole") = hole();
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;
Mesh.ElementOrder = 2;

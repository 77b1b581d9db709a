// A box of 2 x 1 x 1 of tetrahedra, the lower and the upper half, the upper one without a name.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 1, 0.5};
Box(2) = {0, 0, 0.5, 2, 1, 0.5};
BooleanFragments{ Volume{1}; Delete; }{ Volume{2}; Delete; }
ground() = Surface In BoundingBox {-0.1, -0.1, -0.1, 2.1, 1.1, 0.1};
middle() = Surface In BoundingBox {-0.1, -0.1, 0.4, 2.1, 1.1, 0.6};
Physical Volume("lower") = {1};
Physical Volume(9) = {2};
Physical Surface("ground") = ground();
Physical Surface("middle") = middle();
Mesh.MeshSizeMin = 2;
Mesh.MeshSizeMax = 2;

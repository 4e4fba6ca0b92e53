// A vase of stoneware, 0.24 m high: a profile with a wall of 8 mm, turned once round the axis z.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0};
Point(2) = {0.042, 0, 0};
Point(3) = {0.074, 0, 0.07};
Point(4) = {0.070, 0, 0.125};
Point(5) = {0.034, 0, 0.19};
Point(6) = {0.046, 0, 0.24};
Point(7) = {0.038, 0, 0.24};
Point(8) = {0.026, 0, 0.19};
Point(9) = {0.062, 0, 0.125};
Point(10) = {0.065, 0, 0.07};
Point(11) = {0.034, 0, 0.011};
Point(12) = {0, 0, 0.011};
Line(1) = {1, 2}; Spline(2) = {2, 3, 4, 5, 6}; Line(3) = {6, 7}; Spline(4) = {7, 8, 9, 10, 11}; Line(5) = {11, 12}; Line(6) = {12, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
body[] = Extrude {{0, 0, 1}, {0, 0, 0}, 2*Pi} { Surface{1}; };
Physical Volume("vase", 1) = {body[1]};
Mesh.MeshSizeMin = 0.0105; Mesh.MeshSizeMax = 0.0105; Mesh.Optimize = 1; Mesh.Algorithm = 6;

// Distances and a path on a mesh, with VTK, where the answer is known: on a sphere of radius 1.
//
//     sphere OUTPUT.vtp PATH.vtp
//
// Writes the sphere with the distance of each vertex from the first one, and the path to it from the
// one that is farthest away. Prints, on one line, how far off the distances are on average and at most,
// and then the length of the path.
#include "line.h"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>
#include <vtkSphereSource.h>

#include <heatpath.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iostream>

namespace {

void print_errors(vtkPolyData *surface, vtkDoubleArray *distances)
{
    double sum = 0, largest = 0, pole[3], point[3];
    surface->GetPoint(0, pole);
    const vtkIdType count = surface->GetNumberOfPoints();
    for (vtkIdType i = 0; i < count; ++i) {
        surface->GetPoint(i, point);
        const double cosine = pole[0] * point[0] + pole[1] * point[1] + pole[2] * point[2];
        const double truth = std::acos(std::clamp(cosine, -1.0, 1.0));
        const double error = std::abs(distances->GetValue(i) - truth);
        sum += error;
        largest = std::max(largest, error);
    }
    std::printf("mean %.6f largest %.6f", sum / count, largest);
}

void run(const char *surface_name, const char *path_name)
{
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1);
    sphere->SetThetaResolution(96);
    sphere->SetPhiResolution(49);
    sphere->LatLongTessellationOn(); // quadrilaterals: faces need not be triangles
    sphere->Update();
    vtkPolyData *surface = sphere->GetOutput();

    const heatpath::MeshSolver solver(heatpath::mesh(surface));
    const std::int64_t first = 0;
    const auto source = heatpath::SurfacePoints::vertices({&first, 1});
    vtkNew<vtkDoubleArray> distances;
    distances->SetName("distance");
    distances->SetNumberOfTuples(surface->GetNumberOfPoints());
    solver.distances(source, heatpath::array(distances));
    surface->GetPointData()->SetScalars(distances);
    write(surface, surface_name);
    print_errors(surface, distances);

    const double *values = distances->GetPointer(0);
    const std::int64_t last =
        std::max_element(values, values + distances->GetNumberOfTuples()) - values;
    const auto end = heatpath::SurfacePoints::vertices({&last, 1});
    const heatpath::Path<3> path = solver.paths(source, end)[0];
    std::printf(" path %.6f\n", path.info.length);
    write_line(path.points, path_name);
}

} // namespace

int main(int count, char **arguments)
{
    if (count != 3) {
        std::cerr << "usage: sphere OUTPUT.vtp PATH.vtp\n";
        return 2;
    }
    try {
        run(arguments[1], arguments[2]);
    } catch (const std::exception &error) {
        std::cerr << "sphere: " << error.what() << '\n';
        return 1;
    }
}

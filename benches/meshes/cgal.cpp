// CGAL's heat method with CHOLMOD on one mesh: cgal MESH.off SOLVES; prints a line of JSON.
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/CholmodSupport>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Matrix = CGAL::Eigen_sparse_matrix<double>::EigenType;
using Solver = CGAL::Eigen_solver_traits<Eigen::CholmodSupernodalLLT<Matrix>>;
using Heat = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<
    Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay,
    boost::property_map<Mesh, CGAL::vertex_point_t>::const_type, Solver>;

static double seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

// A line of /proc/self/status, in MiB.
static double memory(const std::string &name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.compare(0, name.size(), name) == 0)
            return std::atof(line.c_str() + name.size() + 1) / 1024;
    }
    return 0;
}

int main(int, char **arguments) {
    std::ifstream file(arguments[1]);
    Mesh mesh;
    file >> mesh;
    const int solves = std::atoi(arguments[2]);
    const double loaded = memory("VmRSS");
    double start = seconds();
    Heat heat(mesh);
    auto distances = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance", 0).first;
    heat.add_source(Mesh::Vertex_index(0));
    heat.estimate_geodesic_distances(distances);
    const double first = seconds() - start;
    std::ostringstream times, values;
    values.precision(17);
    for (int solve = 0; solve < solves; ++solve) {
        heat.clear_sources();
        heat.add_source(Mesh::Vertex_index(0));
        start = seconds();
        heat.estimate_geodesic_distances(distances);
        times << (solve ? "," : "") << seconds() - start;
    }
    std::ofstream output(arguments[3], std::ios::binary);
    for (auto vertex : mesh.vertices())
        output.write(reinterpret_cast<const char *>(&distances[vertex]), sizeof(double));
    std::cout << "{\"first\":" << first << ",\"solves\":[" << times.str()
              << "],\"memory\":" << memory("VmHWM") - loaded << "}\n";
    return 0;
}

/* heatpath for C++17: a thin layer over heatpath.h that frees what it owns and throws what fails.
 *
 * Nothing is copied but results: pixels, points and faces are described where they are. All of it is
 * in this file; link with libheatpath.
 *
 * Include OpenCV's <opencv2/core.hpp>, VTK's <vtkImageData.h>, <vtkPolyData.h> or ITK's <itkImage.h>
 * before this file, and heatpath::buffer() takes their images, heatpath::mesh() their meshes.
 *
 *     heatpath::Options options;
 *     options.medium = HP_MEDIUM_VESSELNESS;
 *     auto paths = heatpath::paths<2>(heatpath::buffer(picture), {{300, 411}}, {{1230, 303}}, options);
 */
#ifndef HEATPATH_HPP
#define HEATPATH_HPP

#include "heatpath.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace heatpath {

/** What is thrown if a call fails. */
class Error : public std::runtime_error {
public:
    explicit Error(hp_status status)
        : std::runtime_error(hp_last_error_message()), status_(status)
    {
    }

    /** One of HP_..., never HP_OK. */
    hp_status status() const noexcept { return status_; }

    /** The name of the status, such as "HP_INVALID_POINT". */
    const char *name() const noexcept { return hp_status_name(status_); }

private:
    hp_status status_;
};

/** Throws an Error unless the status is HP_OK. */
inline void check(hp_status status)
{
    if (status != HP_OK)
        throw Error(status);
}

/** The HP_ constant for numbers of type T. */
template <class T>
constexpr std::uint32_t type_of()
{
    using U = std::remove_cv_t<T>;
    static_assert(std::is_arithmetic_v<U> && !std::is_same_v<U, bool>, "an integer or a float");
    if constexpr (std::is_floating_point_v<U>) {
        static_assert(sizeof(U) == 4 || sizeof(U) == 8, "float or double");
        return sizeof(U) == 4 ? HP_F32 : HP_F64;
    } else {
        constexpr bool is_signed = std::is_signed_v<U>;
        switch (sizeof(U)) {
        case 1: return is_signed ? HP_I8 : HP_U8;
        case 2: return is_signed ? HP_I16 : HP_U16;
        case 4: return is_signed ? HP_I32 : HP_U32;
        default: return is_signed ? HP_I64 : HP_U64;
        }
    }
}

/** A point in pixel coordinates, or in space. */
template <std::size_t N>
using Point = std::array<double, N>;

/** Points of an image (N = 2), or of a volume or surface (N = 3). */
template <std::size_t N>
using Points = std::vector<Point<N>>;

/** Described pixels, see hp_buffer; the fields can be changed. */
struct Buffer : hp_buffer {
    Buffer() { check(hp_buffer_init(this, sizeof(hp_buffer))); }

    /** Pixels without gaps: columns, rows and, of a volume, slices. Input is only read. */
    template <class T>
    Buffer(T *pixels, std::initializer_list<std::size_t> sizes) : Buffer()
    {
        data = const_cast<std::remove_const_t<T> *>(pixels);
        type = type_of<T>();
        dimension = static_cast<std::uint32_t>(sizes.size());
        std::size_t axis = 0;
        for (std::size_t n : sizes)
            if (axis < 3)
                size[axis++] = n;
    }

    std::size_t pixels() const { return size[0] * size[1] * (dimension == 3 ? size[2] : 1); }
};

/** Described items, see hp_array; the fields can be changed. */
struct Array : hp_array {
    /** How many numbers an item has, so that no more are read; 0 if only the caller knows. */
    std::size_t width = 0;

    Array() { check(hp_array_init(this, sizeof(hp_array))); }

    /** Items without gaps; an item may be several numbers. Input is only read. */
    template <class T>
    Array(T *items, std::size_t item_count) : Array()
    {
        data = const_cast<std::remove_const_t<T> *>(items);
        type = type_of<T>();
        count = item_count;
    }

    /** The numbers of a container, one an item. */
    template <class Container, class T = std::remove_pointer_t<decltype(
                                   std::declval<Container &>().data())>,
              class = std::enable_if_t<std::is_arithmetic_v<T>>>
    Array(Container &container) : Array(container.data(), container.size())
    {
        width = 1;
    }

    /** The points of a container, one an item. */
    template <class Container, class P = std::remove_pointer_t<decltype(
                                   std::declval<Container &>().data())>,
              class = typename P::value_type, class = void>
    Array(Container &container)
        : Array(container.empty() ? nullptr : container.data()->data(), container.size())
    {
        width = std::tuple_size<P>::value;
    }
};

namespace detail {

/** Calls the caller's function, and keeps what it throws until the library has returned. */
struct Watch {
    std::function<bool(double)> progress;
    std::exception_ptr thrown;

    static int report(double finished, void *user) noexcept
    {
        auto *watch = static_cast<Watch *>(user);
        try {
            return watch->progress(finished) ? 0 : 1;
        } catch (...) {
            watch->thrown = std::current_exception();
            return 1;
        }
    }
};

/** Calls the library with options whose progress may throw. */
template <class Options, class Call>
void run(const Options &options, Call call)
{
    auto plain = static_cast<typename Options::Plain>(options);
    Watch watch{options.on_progress, nullptr};
    if (watch.progress) {
        plain.progress = &Watch::report;
        plain.user = &watch;
    }
    const hp_status status = call(&plain);
    if (watch.thrown)
        std::rethrow_exception(watch.thrown);
    check(status);
}

/** A handle of the library, which frees it. */
template <class Handle, void (*free_handle)(Handle *)>
using Owned = std::unique_ptr<Handle, std::integral_constant<void (*)(Handle *), free_handle>>;

using PathsHandle = Owned<hp_paths, hp_paths_free>;
using GraphHandle = Owned<hp_graph, hp_graph_free>;

/** As run(); the handle that the call makes. */
template <class Handle, class Options, class Call>
Handle make(const Options &options, Call call)
{
    typename Handle::pointer handle = nullptr;
    run(options, [&](auto *plain) { return call(plain, &handle); });
    return Handle(handle);
}

/* A buffer that was described is wanted, also if it is empty: then it is refused. */
inline const hp_buffer *optional(const Buffer &buffer)
{
    return buffer.data || buffer.type ? &buffer : nullptr;
}

inline void check_dimension(const Buffer &image, std::size_t of_points)
{
    if (image.dimension != of_points)
        throw std::invalid_argument("heatpath: points have " + std::to_string(of_points) +
                                    " coordinates, but the image has " +
                                    std::to_string(image.dimension) + " axes");
}

/* The coordinates of points of an image with as many axes. */
template <std::size_t N>
const double *coordinates(const Buffer &image, const Points<N> &points)
{
    check_dimension(image, N);
    return points.empty() ? nullptr : points.front().data();
}

/* The list, if its items have so many numbers as the library will read. */
inline const Array &with_width(const Array &list, std::size_t width, const char *name)
{
    if (list.width != 0 && list.width != width)
        throw std::invalid_argument("heatpath: " + std::string(name) + " need " +
                                    std::to_string(width) + " numbers an item, but there are " +
                                    std::to_string(list.width));
    return list;
}

} // namespace detail

/** What to compute and how, see hp_options. */
struct Options : hp_options {
    using Plain = hp_options;
    Options() { check(hp_options_init(this, sizeof(hp_options))); }

    /** Is told the finished part, 0 to 1; false cancels (an Error of HP_CANCELLED), and what it
     * throws is thrown on. */
    std::function<bool(double)> on_progress;
};

/** How votes find curves, see hp_vote_options. */
struct VoteOptions : hp_vote_options {
    VoteOptions() { check(hp_vote_options_init(this, sizeof(hp_vote_options))); }
};

/** How key points find curves, see hp_key_point_options. */
struct KeyPointOptions : hp_key_point_options {
    KeyPointOptions() { check(hp_key_point_options_init(this, sizeof(hp_key_point_options))); }
};

/** A path from an end to a source; info tells how it ended. */
template <std::size_t N>
struct Path {
    hp_path_info info;
    Points<N> points;

    bool arrived() const { return info.ending == HP_ENDED_SOURCE; }
};

/** Curves between nodes. */
template <std::size_t N>
struct Graph {
    struct Branch {
        hp_graph_branch info;
        Points<N> points;
        std::vector<double> radii;
    };

    hp_graph_info info;
    std::vector<hp_graph_node> nodes;
    std::vector<Branch> branches;
    Points<N> sources;
};

namespace detail {

template <std::size_t N>
std::vector<Path<N>> collect(const hp_paths *handle)
{
    std::uint64_t count = 0;
    check(hp_paths_count(handle, &count));
    std::vector<Path<N>> paths(count);
    for (std::uint64_t i = 0; i < count; i++) {
        paths[i].info.struct_size = sizeof(hp_path_info);
        check(hp_paths_info(handle, i, &paths[i].info));
        paths[i].points.resize(paths[i].info.point_count);
        check(hp_paths_points(handle, i, paths[i].points.front().data(), paths[i].points.size()));
    }
    return paths;
}

template <std::size_t N>
Graph<N> collect(const hp_graph *handle)
{
    Graph<N> graph;
    graph.info.struct_size = sizeof(hp_graph_info);
    check(hp_graph_describe(handle, &graph.info));
    graph.nodes.resize(graph.info.node_count);
    for (std::uint64_t i = 0; i < graph.info.node_count; i++) {
        graph.nodes[i].struct_size = sizeof(hp_graph_node);
        check(hp_graph_node_at(handle, i, &graph.nodes[i]));
    }
    graph.branches.resize(graph.info.branch_count);
    for (std::uint64_t i = 0; i < graph.info.branch_count; i++) {
        auto &branch = graph.branches[i];
        branch.info.struct_size = sizeof(hp_graph_branch);
        check(hp_graph_branch_at(handle, i, &branch.info));
        branch.points.resize(branch.info.point_count);
        branch.radii.resize(branch.info.point_count);
        check(hp_graph_branch_points(handle, i, branch.points.front().data(), branch.radii.data(),
                                     branch.points.size()));
    }
    graph.sources.resize(graph.info.source_count);
    if (!graph.sources.empty())
        check(hp_graph_sources(handle, graph.sources.front().data(), graph.sources.size()));
    return graph;
}

} // namespace detail

/** Writes the distance of every pixel from the nearest source; see hp_distance(). */
template <std::size_t N>
void distance(const Buffer &image, const Points<N> &sources, const Buffer &result,
              const Options &options = {}, const Buffer &mask = {})
{
    detail::run(options, [&](const hp_options *plain) {
        return hp_distance(&image, detail::optional(mask), detail::coordinates(image, sources),
                           sources.size(), plain, &result);
    });
}

/** The distance of every pixel from the nearest source, row by row. */
template <std::size_t N>
std::vector<double> distance(const Buffer &image, const Points<N> &sources, const Options &options = {},
                             const Buffer &mask = {})
{
    std::vector<double> distances(image.pixels());
    Buffer result(distances.data(), {image.size[0], image.size[1]});
    result.dimension = image.dimension;
    result.size[2] = image.size[2];
    distance(image, sources, result, options, mask);
    return distances;
}

/** Writes the medium that the options make of an image; see hp_medium(). */
template <std::size_t N>
void medium(const Buffer &image, const Points<N> &sources, const Buffer &result,
            const Options &options = {}, const Buffer &mask = {})
{
    detail::run(options, [&](const hp_options *plain) {
        return hp_medium(&image, detail::optional(mask), detail::coordinates(image, sources),
                         sources.size(), plain, &result);
    });
}

/** The scales of the tubes that an image shows, for Options::scales; see hp_tube_scales(). */
inline std::vector<double> tube_scales(const Buffer &image, const Options &options, const Buffer &mask = {})
{
    double scales[HP_MOST_TUBE_SCALES];
    std::uint64_t n = 0;
    detail::run(options, [&](auto *o) { return hp_tube_scales(&image, detail::optional(mask), o, scales, &n); });
    return {scales, scales + n};
}

/** The minimal path from each end to a source, in the order of the ends; see hp_paths_create(). */
template <std::size_t N>
std::vector<Path<N>> paths(const Buffer &image, const Points<N> &sources, const Points<N> &ends,
                           const Options &options = {}, const Buffer &mask = {})
{
    const auto handle = detail::make<detail::PathsHandle>(options, [&](auto *plain, auto **made) {
        return hp_paths_create(&image, detail::optional(mask), detail::coordinates(image, sources),
                               sources.size(), detail::coordinates(image, ends), ends.size(), plain, made);
    });
    return detail::collect<N>(handle.get());
}

/** Where the results of Solver::nearest() go; what is left out is not wanted. */
struct NearestMaps {
    Buffer distance;
    Buffer labels;
    Buffer shares;
    std::int64_t share_stride = 0;
};

/** A medium prepared for distances and paths from any sources; threads may share it. */
class Solver {
public:
    explicit Solver(const Buffer &image, const Options &options, const Buffer &mask = {})
        : image_(image)
    {
        handle_ = detail::make<decltype(handle_)>(options, [&](auto *plain, auto **made) {
            return hp_solver_create(&image, detail::optional(mask), plain, made);
        });
    }

    /** One map for each source, the first one in result; see hp_solver_distances(). */
    template <std::size_t N>
    void distances(const Points<N> &sources, const Buffer &result, const Options &options = {},
                   std::int64_t map_stride = 0) const
    {
        detail::run(options, [&](const hp_options *plain) {
            return hp_solver_distances(get(), detail::coordinates(image_, sources), sources.size(), plain,
                                       &result, map_stride);
        });
    }

    /** As heatpath::paths(). */
    template <std::size_t N>
    std::vector<Path<N>> paths(const Points<N> &sources, const Points<N> &ends, const Options &options = {}) const
    {
        const auto handle = detail::make<detail::PathsHandle>(options, [&](auto *plain, auto **made) {
            return hp_solver_paths_create(get(), detail::coordinates(image_, sources), sources.size(),
                                          detail::coordinates(image_, ends), ends.size(), plain, made);
        });
        return detail::collect<N>(handle.get());
    }

    /** How far every pixel is from the nearest source, and which one that is; see
     * hp_solver_nearest(). */
    template <std::size_t N>
    void nearest(const Points<N> &sources, const NearestMaps &maps, const Options &options = {}) const
    {
        detail::run(options, [&](const hp_options *plain) {
            return hp_solver_nearest(get(), detail::coordinates(image_, sources), sources.size(), plain,
                                     detail::optional(maps.distance), detail::optional(maps.labels),
                                     detail::optional(maps.shares), maps.share_stride);
        });
    }

    /** The distance from each point to each of others, row by row; see hp_solver_matrix(). */
    template <std::size_t N>
    std::vector<double> matrix(const Points<N> &from, const Points<N> &to,
                               const Options &options = {}) const
    {
        std::vector<double> distances(from.size() * to.size());
        const Array row(distances.data(), to.size());
        detail::run(options, [&](const hp_options *plain) {
            return hp_solver_matrix(get(), detail::coordinates(image_, from), from.size(),
                                    detail::coordinates(image_, to), to.size(), plain, &row, 0);
        });
        return distances;
    }

    /** Where heat passes on its way from one end to the other; see hp_solver_bridge(). */
    template <std::size_t N>
    void bridge(const Points<N> &from, const Points<N> &to, const Buffer &ln_density,
                const Options &options = {}) const
    {
        detail::run(options, [&](const hp_options *plain) {
            return hp_solver_bridge(get(), detail::coordinates(image_, from), from.size(),
                                    detail::coordinates(image_, to), to.size(), plain, &ln_density);
        });
    }

    const hp_solver *get() const { return handle_.get(); }

private:
    Buffer image_; /* its size alone; the pixels are not looked at again */
    detail::Owned<hp_solver, hp_solver_free> handle_;
};

/** Where the density and the kept pixels of votes go; what is left out is not wanted. */
struct VoteMaps {
    Buffer density;
    Buffer kept;
};

/** The curves of an image, by votes; without sources they are looked for; see hp_votes_create(). */
template <std::size_t N>
Graph<N> votes(const Buffer &image, const Points<N> &sources = {}, const Options &options = {},
               const VoteOptions &vote_options = {}, const VoteMaps &maps = {},
               const Buffer &mask = {})
{
    const auto handle = detail::make<detail::GraphHandle>(options, [&](auto *plain, auto **made) {
        return hp_votes_create(&image, detail::optional(mask), detail::coordinates(image, sources),
                               sources.size(), plain, &vote_options, detail::optional(maps.density),
                               detail::optional(maps.kept), made);
    });
    return detail::collect<N>(handle.get());
}

/** The curves of an image, from key point to key point; see hp_key_points_create(). */
template <std::size_t N>
Graph<N> key_points(const Buffer &image, const Points<N> &sources = {}, const Options &options = {},
                    const KeyPointOptions &key_point_options = {}, const Buffer &mask = {})
{
    const auto handle = detail::make<detail::GraphHandle>(options, [&](auto *plain, auto **made) {
        return hp_key_points_create(&image, detail::optional(mask), detail::coordinates(image, sources),
                                    sources.size(), plain, &key_point_options, made);
    });
    return detail::collect<N>(handle.get());
}

/** The centreline of a mask with radii; see hp_skeleton_create(). */
template <std::size_t N>
Graph<N> skeleton(const Buffer &mask, double prune = 0)
{
    detail::check_dimension(mask, N);
    hp_graph *handle = nullptr;
    check(hp_skeleton_create(&mask, prune, &handle));
    return detail::collect<N>(detail::GraphHandle(handle).get());
}

/** Curves to compare: polylines one after the other, or the pixels of a mask; see hp_curves. */
class Curves {
public:
    /** Polylines in pixel coordinates. */
    template <std::size_t N>
    explicit Curves(const std::vector<Points<N>> &polylines, Point<N> spacing)
    {
        check(hp_curves_init(&plain_, sizeof plain_));
        plain_.dimension = N;
        for (std::size_t axis = 0; axis < N; axis++)
            plain_.spacing[axis] = spacing[axis];
        starts_.push_back(0);
        for (const auto &polyline : polylines) {
            for (const auto &point : polyline)
                coordinates_.insert(coordinates_.end(), point.begin(), point.end());
            starts_.push_back(coordinates_.size() / N);
        }
        points_array_ = Array(coordinates_.data(), coordinates_.size() / N);
        starts_array_ = Array(starts_);
    }

    /** The pixels that are not 0. */
    explicit Curves(const Buffer &mask) : mask_(mask)
    {
        check(hp_curves_init(&plain_, sizeof plain_));
    }

    Curves(const Curves &) = delete; /* the arrays point to the vectors */
    Curves(Curves &&) = default;

    hp_curves plain() const
    {
        hp_curves curves = plain_;
        curves.mask = detail::optional(mask_);
        curves.points = curves.mask ? nullptr : &points_array_;
        curves.starts = curves.mask ? nullptr : &starts_array_;
        return curves;
    }

private:
    hp_curves plain_;
    std::vector<double> coordinates_;
    std::vector<std::uint64_t> starts_;
    Array points_array_, starts_array_;
    Buffer mask_;
};

/** Recall and precision by length; see hp_evaluate(). */
inline hp_score evaluate(const Curves &extracted, const Curves &truth, double tolerance,
                         const Buffer &view = {})
{
    hp_score score;
    score.struct_size = sizeof score;
    const hp_curves ours = extracted.plain(), theirs = truth.plain();
    check(hp_evaluate(&ours, &theirs, detail::optional(view), tolerance, &score));
    return score;
}

/** What to compute on a mesh and how, see hp_mesh_options. */
struct MeshOptions : hp_mesh_options {
    using Plain = hp_mesh_options;
    MeshOptions() { check(hp_mesh_options_init(this, sizeof(hp_mesh_options))); }

    /** As Options::on_progress. */
    std::function<bool(double)> on_progress;
};

/** Points of a surface, see hp_surface_points. The numbers are not copied: they must outlive this. */
class SurfacePoints {
public:
    /** Vertices, by their numbers. */
    static SurfacePoints vertices(const Array &numbers)
    {
        SurfacePoints points;
        points.vertices_ = detail::with_width(numbers, 1, "vertices");
        return points;
    }

    /** Positions in space: the nearest points of the surface. */
    static SurfacePoints positions(const Array &xyz)
    {
        SurfacePoints points;
        points.positions_ = detail::with_width(xyz, 3, "positions");
        return points;
    }

    /** One source: a curve through positions in space, laid onto the surface. */
    static SurfacePoints curve(const Array &xyz)
    {
        SurfacePoints points = positions(xyz);
        points.is_curve_ = true;
        return points;
    }

    /** Places on faces, by the weights of their three corners. */
    static SurfacePoints on_faces(const Array &faces, const Array &weights)
    {
        SurfacePoints points;
        points.faces_ = detail::with_width(faces, 1, "faces");
        points.weights_ = detail::with_width(weights, 3, "weights");
        return points;
    }

    /** The distance at each source. */
    SurfacePoints &offsets(const Array &list)
    {
        offsets_ = detail::with_width(list, 1, "offsets");
        return *this;
    }

    /** How the sources are called in results. */
    SurfacePoints &labels(const Array &list)
    {
        labels_ = detail::with_width(list, 1, "labels");
        return *this;
    }

    hp_surface_points plain() const
    {
        hp_surface_points points;
        check(hp_surface_points_init(&points, sizeof points));
        const auto place = [](const std::optional<Array> &list) { return list ? &*list : nullptr; };
        points.curve = is_curve_;
        points.vertices = place(vertices_);
        points.positions = place(positions_);
        points.faces = place(faces_);
        points.weights = place(weights_);
        points.offsets = place(offsets_);
        points.labels = place(labels_);
        return points;
    }

private:
    SurfacePoints() = default;

    bool is_curve_ = false;
    std::optional<Array> vertices_, positions_, faces_, weights_, offsets_, labels_;
};

/** Points on the faces of a mesh. */
struct Places {
    std::vector<std::uint32_t> faces;
    Points<3> weights;

    Places() = default;
    explicit Places(std::size_t count) : faces(count), weights(count) {}

    /** The same for a call; they must outlive it. */
    SurfacePoints points() const { return SurfacePoints::on_faces(faces, weights); }
};

/** A path or curve on a mesh, with its points in space and on faces. */
struct SurfacePath : Path<3> {
    Places places;
};

namespace detail {

inline std::vector<SurfacePath> collect_surface(const hp_paths *handle)
{
    std::vector<SurfacePath> curves;
    for (Path<3> &path : collect<3>(handle)) {
        SurfacePath curve{std::move(path), Places(path.info.point_count)};
        const Array faces(curve.places.faces), weights(curve.places.weights);
        check(hp_paths_places(handle, curves.size(), &faces, &weights));
        curves.push_back(std::move(curve));
    }
    return curves;
}

} // namespace detail

/** The principal curvatures at each vertex and their tangents, see hp_mesh_curvature(). */
struct Curvature {
    std::vector<double> smallest, largest;
    Points<3> smallest_directions, largest_directions;
};

/** A triangle mesh, cleaned; threads may share it. */
class Mesh {
public:
    /** x, y, z of each vertex, and three vertices of each face; see hp_mesh_create(). */
    Mesh(const Array &points, const Array &faces, const MeshOptions &options = {})
        : Mesh(points, faces, nullptr, options)
    {
    }

    /** Polygons, whose corners begin at starts. */
    Mesh(const Array &points, const Array &corners, const Array &starts,
         const MeshOptions &options = {})
        : Mesh(points, corners, &starts, options)
    {
    }

    /** What the mesh is like. */
    hp_mesh_report report() const
    {
        hp_mesh_report report;
        report.struct_size = sizeof report;
        check(hp_mesh_describe(get(), &report));
        return report;
    }

    /** The three vertices of each face; see hp_mesh_faces(). */
    std::vector<std::array<std::uint32_t, 3>> faces() const
    {
        std::vector<std::array<std::uint32_t, 3>> corners(report().faces);
        const Array target(corners);
        check(hp_mesh_faces(get(), &target));
        return corners;
    }

    /** How the surface bends. */
    Curvature curvature(const MeshOptions &options = {}) const
    {
        const std::size_t count = report().vertices;
        Curvature bends{std::vector<double>(count), std::vector<double>(count), Points<3>(count),
                        Points<3>(count)};
        const Array values[2] = {bends.smallest, bends.largest};
        const Array tangents[2] = {bends.smallest_directions, bends.largest_directions};
        detail::run(options, [&](const hp_mesh_options *plain) {
            return hp_mesh_curvature(get(), plain, &values[0], &values[1], &tangents[0],
                                     &tangents[1]);
        });
        return bends;
    }

    /** Where points lie on the faces; see hp_mesh_locate(). count: how many there are. */
    Places locate(const SurfacePoints &points, std::size_t count) const
    {
        Places places(count);
        const hp_surface_points plain = points.plain();
        const Array faces(places.faces), weights(places.weights);
        check(hp_mesh_locate(get(), &plain, &faces, &weights, nullptr));
        return places;
    }

    /** The curves along which a function of the vertices has one of some values; see
     * hp_mesh_isolines_create(). */
    std::vector<SurfacePath> isolines(const Array &values, const Array &levels) const
    {
        detail::with_width(values, 1, "values");
        detail::with_width(levels, 1, "levels");
        hp_paths *handle = nullptr;
        check(hp_mesh_isolines_create(get(), &values, &levels, &handle));
        return detail::collect_surface(detail::PathsHandle(handle).get());
    }

    /** A closed curve made locally shortest, or none; see hp_mesh_loop_create(). */
    std::vector<SurfacePath> loop(const SurfacePoints &points) const
    {
        hp_paths *handle = nullptr;
        const hp_surface_points plain = points.plain();
        check(hp_mesh_loop_create(get(), &plain, &handle));
        return detail::collect_surface(detail::PathsHandle(handle).get());
    }

    const hp_mesh *get() const { return handle_.get(); }

private:
    Mesh(const Array &points, const Array &faces, const Array *starts, const MeshOptions &options)
    {
        detail::with_width(points, 3, "points");
        detail::with_width(faces, starts ? 1 : 3, starts ? "corners" : "faces");
        if (starts)
            detail::with_width(*starts, 1, "starts");
        handle_ = detail::make<decltype(handle_)>(options, [&](auto *plain, auto **made) {
            return hp_mesh_create(&points, &faces, starts, plain, made);
        });
    }

    detail::Owned<hp_mesh, hp_mesh_free> handle_;
};

/** A medium on a mesh, prepared for distances and paths from any sources; threads may share it. */
class MeshSolver {
public:
    explicit MeshSolver(const Mesh &mesh, const MeshOptions &options = {})
        : vertices_(mesh.report().vertices)
    {
        handle_ = detail::make<decltype(handle_)>(options, [&](auto *plain, auto **made) {
            return hp_mesh_solver_create(mesh.get(), plain, made);
        });
    }

    /** The distance of every vertex from the nearest source; see hp_mesh_solver_distances(). */
    std::vector<double> distances(const SurfacePoints &sources, const MeshOptions &options = {}) const
    {
        std::vector<double> result(vertices_);
        distances(sources, Array(result), options);
        return result;
    }

    /** The same into a list of one number for each vertex, and the label of the nearest source into
     * another one, if it has data. */
    void distances(const SurfacePoints &sources, const Array &result,
                   const MeshOptions &options = {}, const Array &labels = {}) const
    {
        detail::with_width(result, 1, "distances");
        detail::with_width(labels, 1, "labels");
        const hp_surface_points points = sources.plain();
        detail::run(options, [&](const hp_mesh_options *plain) {
            return hp_mesh_solver_distances(get(), &points, plain, &result, 0,
                                            labels.data ? &labels : nullptr, 0);
        });
    }

    /** The distances between all vertices, row by row; see hp_mesh_solver_matrix(). */
    std::vector<double> matrix(const MeshOptions &options = {}) const
    {
        std::vector<double> distances(vertices_ * vertices_);
        const Array row(distances.data(), vertices_);
        detail::run(options, [&](const hp_mesh_options *plain) {
            return hp_mesh_solver_matrix(get(), plain, &row, 0);
        });
        return distances;
    }

    /** The path through some points in their order; see hp_mesh_paths_through(). */
    SurfacePath through(const SurfacePoints &points, const MeshOptions &options = {}) const
    {
        const hp_surface_points places = points.plain();
        const auto handle = detail::make<detail::PathsHandle>(options, [&](auto *plain, auto **made) {
            return hp_mesh_paths_through(get(), &places, plain, made);
        });
        return detail::collect_surface(handle.get()).front();
    }

    /** The shortest path from each end to a source; see hp_mesh_paths_create(). */
    std::vector<SurfacePath> paths(const SurfacePoints &sources, const SurfacePoints &ends,
                               const MeshOptions &options = {}) const
    {
        const hp_surface_points from = sources.plain(), to = ends.plain();
        const auto handle = detail::make<detail::PathsHandle>(options, [&](auto *plain, auto **made) {
            return hp_mesh_paths_create(get(), &from, &to, plain, made);
        });
        return detail::collect_surface(handle.get());
    }

    const hp_mesh_solver *get() const { return handle_.get(); }

private:
    std::size_t vertices_;
    detail::Owned<hp_mesh_solver, hp_mesh_solver_free> handle_;
};

} // namespace heatpath

#endif // HEATPATH_HPP

/* What follows is read again by each include, once there is something to adapt to. */

namespace heatpath {

#if defined(OPENCV_CORE_HPP) && !defined(HEATPATH_HPP_OPENCV)
#define HEATPATH_HPP_OPENCV

/** The HP_ constant for a depth of OpenCV, such as CV_8U; 0 if there is none. */
inline std::uint32_t type_of_depth(int depth)
{
    switch (depth) {
    case CV_8U: return HP_U8;
    case CV_8S: return HP_I8;
    case CV_16U: return HP_U16;
    case CV_16S: return HP_I16;
    case CV_32S: return HP_I32;
    case CV_32F: return HP_F32;
    case CV_64F: return HP_F64;
    default: return 0;
    }
}

/** A picture or volume of OpenCV, or a part of one; of a coloured one the given channel. */
inline Buffer buffer(const cv::Mat &mat, int channel = 0)
{
    if (channel < 0 || channel >= mat.channels())
        throw std::invalid_argument("heatpath: the picture has no channel " +
                                    std::to_string(channel));
    Buffer buffer;
    buffer.type = type_of_depth(mat.depth());
    buffer.dimension = static_cast<std::uint32_t>(mat.dims);
    buffer.data = mat.data ? mat.data + static_cast<std::size_t>(channel) * mat.elemSize1() : nullptr;
    for (int axis = 0; axis < mat.dims && axis < 3; axis++) {
        buffer.size[axis] = static_cast<std::uint64_t>(mat.size[mat.dims - 1 - axis]);
        buffer.byte_stride[axis] = static_cast<std::int64_t>(mat.step[mat.dims - 1 - axis]);
    }
    return buffer;
}

#endif

#if (defined(vtkImageData_h) || defined(vtkPolyData_h)) && !defined(HEATPATH_HPP_VTK)
#define HEATPATH_HPP_VTK

/** The HP_ constant for a type of VTK, such as VTK_SHORT; 0 if there is none. */
inline std::uint32_t type_of_vtk(int type)
{
    switch (type) {
    case VTK_CHAR: return type_of<char>();
    case VTK_SIGNED_CHAR: return HP_I8;
    case VTK_UNSIGNED_CHAR: return HP_U8;
    case VTK_SHORT: return HP_I16;
    case VTK_UNSIGNED_SHORT: return HP_U16;
    case VTK_INT: return HP_I32;
    case VTK_UNSIGNED_INT: return HP_U32;
    case VTK_LONG: return type_of<long>();
    case VTK_UNSIGNED_LONG: return type_of<unsigned long>();
    case VTK_LONG_LONG: return HP_I64;
    case VTK_UNSIGNED_LONG_LONG: return HP_U64;
    case VTK_ID_TYPE: return type_of<vtkIdType>();
    case VTK_FLOAT: return HP_F32;
    case VTK_DOUBLE: return HP_F64;
    default: return 0;
    }
}

#endif

#if defined(vtkImageData_h) && !defined(HEATPATH_HPP_VTK_IMAGE)
#define HEATPATH_HPP_VTK_IMAGE

/** The scalars of a VTK image with its spacing; of several components the given one. Pixel 0, 0, 0 is the
 * first one of the extent. Flat in z it is a picture; flat in x or y a volume one voxel thick. */
inline Buffer buffer(vtkImageData *image, int component = 0)
{
    auto *scalars = static_cast<char *>(image->GetScalarPointer());
    if (!scalars || component < 0 || component >= image->GetNumberOfScalarComponents())
        throw std::invalid_argument("heatpath: the image has no scalars with component " +
                                    std::to_string(component));
    Buffer buffer;
    const int *size = image->GetDimensions();
    const int bytes = image->GetScalarSize();
    const int components = image->GetNumberOfScalarComponents();
    buffer.type = type_of_vtk(image->GetScalarType());
    buffer.dimension = size[2] > 1 ? 3 : 2;
    buffer.data = scalars + component * bytes;
    for (int axis = 0; axis < 3; axis++) {
        buffer.size[axis] = static_cast<std::uint64_t>(size[axis]);
        buffer.spacing[axis] = image->GetSpacing()[axis];
    }
    buffer.byte_stride[0] = static_cast<std::int64_t>(bytes) * components;
    return buffer;
}

#endif

#if defined(vtkPolyData_h) && !defined(HEATPATH_HPP_VTK_MESH)
#define HEATPATH_HPP_VTK_MESH

/** The tuples of a VTK array: the points of a mesh, or a number for each vertex. */
inline Array array(vtkDataArray *tuples)
{
    if (!tuples)
        throw std::invalid_argument("heatpath: there is no array");
    Array array;
    array.width = static_cast<std::size_t>(tuples->GetNumberOfComponents());
    array.type = type_of_vtk(tuples->GetDataType());
    array.data = tuples->GetVoidPointer(0);
    array.count = static_cast<std::uint64_t>(tuples->GetNumberOfTuples());
    return array;
}

/** The polygons of a VTK mesh; its vertices are numbered as there. */
inline Mesh mesh(vtkPolyData *surface, const MeshOptions &options = {})
{
    if (!surface->GetPoints())
        throw std::invalid_argument("heatpath: the surface has no points");
    if (surface->GetNumberOfStrips() > 0)
        throw std::invalid_argument("heatpath: the surface has strips: put vtkTriangleFilter before");
    vtkCellArray *polygons = surface->GetPolys();
    return Mesh(array(surface->GetPoints()->GetData()), array(polygons->GetConnectivityArray()),
                array(polygons->GetOffsetsArray()), options);
}

#endif

#if defined(itkImage_h) && !defined(HEATPATH_HPP_ITK)
#define HEATPATH_HPP_ITK

/** The buffered region of an ITK image with its spacing. Pixel 0, 0, 0 is the first one of the region. */
template <class Pixel, unsigned int N>
Buffer buffer(itk::Image<Pixel, N> *image)
{
    static_assert(N == 2 || N == 3, "a picture or a volume");
    Buffer buffer;
    const auto size = image->GetBufferedRegion().GetSize();
    buffer.type = type_of<Pixel>();
    buffer.dimension = N;
    buffer.data = image->GetBufferPointer();
    for (unsigned int axis = 0; axis < N; axis++) {
        buffer.size[axis] = size[axis];
        buffer.spacing[axis] = image->GetSpacing()[axis];
    }
    return buffer;
}

#endif

} // namespace heatpath

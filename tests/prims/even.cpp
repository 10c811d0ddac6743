// Tests how evenly seeds lie: compares every seed's distance from its nearest neighbour with the required spacing.
#include "prims.h"

#include <algorithm>
#include <cstdio>
#include <unordered_map>

namespace {

// Returns for each point the distance to the nearest other point. Points are sorted into cells of width `cell`; the search
// goes on to further cells as long as they may hold a nearer point.
std::vector<double> nearest(const std::vector<Vec>& points, double cell)
{
    const auto key = [&](int x, int y, int z) {
        return (static_cast<int64_t>(x + 100000) * 300000 + (y + 100000)) * 300000 + (z + 100000);
    };
    const auto at = [&](double a) { return static_cast<int>(std::floor(a / cell)); };
    std::unordered_map<int64_t, std::vector<int>> cells;
    for (size_t i = 0; i < points.size(); ++i)
        cells[key(at(points[i].x), at(points[i].y), at(points[i].z))].push_back(static_cast<int>(i));
    std::vector<double> result;
    for (size_t i = 0; i < points.size(); ++i) {
        double best = 1e9;
        for (int reach = 1; best > reach * cell && reach < 50; ++reach)
            for (int x = -reach; x <= reach; ++x)
                for (int y = -reach; y <= reach; ++y)
                    for (int z = -reach; z <= reach; ++z) {
                        const auto found = cells.find(key(at(points[i].x) + x, at(points[i].y) + y, at(points[i].z) + z));
                        if (found == cells.end())
                            continue;
                        for (int j : found->second)
                            if (static_cast<size_t>(j) != i)
                                best = std::fmin(best, size(points[i] - points[static_cast<size_t>(j)]));
                    }
        result.push_back(best);
    }
    return result;
}

}  // namespace

void testEvenness(bool table)
{
    if (table)
        std::printf("%-40s %7s %8s %12s %8s %8s %8s %8s\n", "object", "spacing", "seeds", "oversampled", "nearest", "mean",
                    "farthest", "within");
    std::vector<Sample> all = MANY;
    all.insert(all.end(), STRETCHED.begin(), STRETCHED.end());
    for (const Sample& sample : all) {
        const double most = sample.stretched() ? 0.5 : 0.35;
        for (const double spacing : {0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0}) {
            // On an object thinner than the spacing, seeds of opposite sides are near each other.
            const double thinnest = std::fmin(sample.size, sample.size2 > 0 ? sample.size2 : sample.size) / 2 *
                                    std::fmin(sample.stretch.x, std::fmin(sample.stretch.y, sample.stretch.z));
            if (sample.stretched() && thinnest < 1.5 * spacing)
                continue;
            Object object = sample.make();
            if (!check(object->resample(real(spacing), makeEngine), "%s: no seeds at %g", sample.name().c_str(), spacing))
                continue;
            std::vector<Vec> points;
            for (int i = 0; i < object->seedSlots(); i += 2)
                points.push_back(vec(object->seedPoint(object->seed(i))));
            const std::vector<double> distances = nearest(points, spacing);
            size_t good = 0;
            double sum = 0;
            for (double d : distances) {
                good += std::fabs(d / spacing - 1) <= most;
                sum += d;
            }
            const double share = 100.0 * static_cast<double>(good) / static_cast<double>(distances.size());
            if (table)
                std::printf("%-40s %7g %8zu %12d %7.0f%% %7.0f%% %7.0f%% %7.2f%%\n", sample.name().c_str(), spacing,
                            distances.size(), object->oversampledSeeds(),
                            100 * *std::min_element(distances.begin(), distances.end()) / spacing,
                            100 * sum / static_cast<double>(distances.size()) / spacing,
                            100 * *std::max_element(distances.begin(), distances.end()) / spacing, share);
            // A few seeds lie closer together where the rings about a pole are flattened by the stretch, and on the ends of cones,
            // which are divided into steps of their own.
            const bool closer = sample.stretched() || object->tapers();
            const bool even = share >= 99 || (closer && (share >= 98 || distances.size() - good <= 8));
            check(even, "%s, spacing %g: nearest neighbours of %.2f%% of seeds lie within %g%% of it", sample.name().c_str(),
                  spacing, share, 100 * most);
        }
    }
}

#include "app/simulation/site.h"

#include "app/simulation/site_builder.h"

#include <algorithm>
#include <cmath>

namespace frustumscreen::simulation {

namespace {

SiteBuilder built(const SiteRequest& request, double detail_m) {
    SiteBuilder builder(detail_m, request.seed);
    if (request.kind == SiteKind::HillTown) {
        build_hill_town(builder);
    } else {
        build_excavation(builder);
    }
    return builder;
}

} // namespace

Site make_site(const SiteRequest& request) {
    const std::size_t wanted = std::max(request.triangles, min_site_triangles);
    double coarse_m = 64.0;
    double fine_m = 2.0;
    while (built(request, fine_m).triangles() < wanted) {
        coarse_m = fine_m;
        fine_m *= 0.5;
    }
    constexpr double close = 1.01;
    while (coarse_m > close * fine_m) {
        const double detail_m = std::sqrt(coarse_m * fine_m);
        (built(request, detail_m).triangles() >= wanted ? fine_m : coarse_m) = detail_m;
    }
    SiteBuilder builder = built(request, coarse_m);
    if ((wanted - builder.triangles()) % 2 == 1) { // splitting adds two at a time
        builder.fly_pennant();
    }
    return builder.finish(wanted, request.size_m);
}

} // namespace frustumscreen::simulation

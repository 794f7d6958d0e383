#include "app/programs/preview/state_pictures.h"

#include "app/programs/preview/front_pictures.h"

#include <array>

namespace frustumscreen::programs {

Result<std::vector<StatePicture>> state_pictures(const std::filesystem::path& pack_file,
                                                 const pack::PackDescription& pack,
                                                 const TurnOptions& options) {
    TRY(const std::vector<pack::PackState> states, pack::states_of(pack));
    constexpr std::array<double, 1> at_once_s{0.0};
    std::vector<StatePicture> all;
    for (const pack::PackState& state : states) {
        TRY(FrontPictures drawn,
            front_pictures(
                pack_file, options, [&](show::OfflineOptions& changed) { changed.state = state.name; },
                at_once_s, [&](double done) { options.progress("state " + state.name, done); }));
        all.push_back({state, std::move(drawn.sheet)});
    }
    return all;
}

} // namespace frustumscreen::programs

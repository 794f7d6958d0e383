#include "app/bench/techniques/peer_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace frustumscreen::bench {

namespace {

struct Named {
    std::string_view name;
    bool PeerChoice::*chosen;
};
constexpr std::array names = {Named{"mesh", &PeerChoice::mesh},
                              Named{"two-pass", &PeerChoice::two_pass},
                              Named{"ray-cast", &PeerChoice::ray_cast},
                              Named{"lod", &PeerChoice::lod},
                              Named{"two-pass-lod", &PeerChoice::two_pass_lod},
                              Named{"relief", &PeerChoice::relief},
                              Named{"relief-cast", &PeerChoice::relief_cast},
                              Named{"relief-gpu", &PeerChoice::relief_gpu}};

} // namespace

Result<PeerChoice> parse_peers(std::string_view words) {
    PeerChoice choice;
    if (words == "all") {
        return choice;
    }
    for (const Named& each : names) {
        choice.*each.chosen = false;
    }
    if (words == "none") {
        return choice;
    }
    for (std::size_t at = 0; at <= words.size();) {
        const std::size_t comma = std::min(words.find(',', at), words.size());
        const std::string_view word = words.substr(at, comma - at);
        const auto* const found =
            std::find_if(names.begin(), names.end(), [word](const Named& each) { return each.name == word; });
        if (found == names.end()) {
            return bad_input(
                "bench.no_peer",
                "there is no peer '{}'; say none, all, or some of mesh, two-pass, "
                "ray-cast, lod, two-pass-lod, relief, relief-cast, relief-gpu with commas between them",
                word);
        }
        choice.*found->chosen = true;
        at = comma + 1;
    }
    return choice;
}

} // namespace frustumscreen::bench

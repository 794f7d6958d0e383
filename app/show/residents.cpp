#include "app/show/residents.h"

#include "firmware_host/base/standard_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>
#include <utility>

namespace frustumscreen {

namespace {

/// Of a level's texture, the mean of an artifact's levels.
std::uint64_t texture_bytes(const PreparedArtifact& artifact) {
    std::uint64_t bytes = 0;
    for (const LevelData& level : artifact.data) {
        for (const Image8& mip : level.mips) {
            bytes += mip.texels.size() * sizeof(glm::u8vec4);
        }
    }
    return bytes / std::max<std::size_t>(artifact.data.size(), 1);
}

} // namespace

Residents::Residents(ResidentsSetUp set_up, PreparedArtifact first)
    : set_up_(std::move(set_up)), loaded_(set_up_.artifacts.size()), records_(loaded_.size()),
      states_(loaded_.size(), ArtifactState::Away) {
    left_out_.reserve(set_up_.left_out.size() + loaded_.size());
    left_out_.insert(left_out_.end(), set_up_.left_out.begin(), set_up_.left_out.end());
    const std::uint64_t texture = texture_bytes(first);
    for (std::size_t k = 0; k < records_.size(); ++k) {
        records_[k].bytes = expected_bytes(set_up_.artifacts[k], texture);
    }
    keep(0, std::move(first));
}

Result<std::unique_ptr<Residents>> Residents::create(ResidentsSetUp set_up, PreparedArtifact first,
                                                     GpuStore& store) {
    std::unique_ptr<Residents> made(new Residents(std::move(set_up), std::move(first)));
    while (made->states_[0] != ArtifactState::Ready) {
        if (Result<void> done = made->upload(store, 0, std::numeric_limits<std::uint64_t>::max()); !done) {
            made->release(store, 0);
            return tl::unexpected<Error>(done.error());
        }
    }
    return made;
}

Residents::~Residents() = default;

void Residents::start(const RungCost& cost, const PropShape& prop, const PlanView& view,
                      const glm::dvec3& eye_m) {
    if (loaded_.size() < 2) {
        return;
    }
    reader_ = std::make_unique<ArtifactReader>(
        [this, cost, prop, view, eye_m](std::size_t artifact, const ArtifactReader::GivenUp& given_up) {
            Result<PreparedArtifact> prepared = prepare_artifact(
                set_up_.artifacts[artifact], set_up_.technique, set_up_.deadline_ms, given_up);
            if (prepared) {
                PlanView seen = view;
                seen.eyes_m = std::span(&eye_m, 1);
                seen.light = set_up_.artifacts[artifact].plan.light;
                prepared->levels.start(cost, prop, seen);
            } else if (!given_up()) {
                say_line(set_up_.program, fmt::format("left out: {}", prepared.error().message));
            }
            return prepared;
        });
}

void Residents::step(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted) {
    step_once(store, shown, wanted);
    while (set_up_.waits && !steady_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        step_once(store, shown, wanted);
    }
}

void Residents::step_once(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted) {
    if (shown_ != shown) {
        shown_ = shown;
        records_[shown].last_shown = ++shows_;
    }
    receive();
    const ResidencyStep next = next_step(records_, shown, wanted, set_up_.budget_bytes);
    if (next.release) {
        release(store, *next.release);
    } else if (reader_) {
        reader_->request(next.load);
    }
    upload(store, shown, wanted);
    const auto arrives = [](const std::unique_ptr<Loaded>& each) { return each && !each->ready(); };
    steady_ =
        !next.release && (!next.load || !reader_) && std::none_of(loaded_.begin(), loaded_.end(), arrives);
}

void Residents::receive() {
    const std::unique_ptr<ArtifactReader::Answer> answer = reader_ ? reader_->take() : nullptr;
    if (!answer || records_[answer->artifact].loaded || records_[answer->artifact].left_out) {
        return;
    }
    if (answer->prepared) {
        keep(answer->artifact, std::move(*answer->prepared));
    } else {
        leave_out(answer->artifact, answer->prepared.error().message);
    }
}

void Residents::keep(std::size_t artifact, PreparedArtifact prepared) {
    auto loaded = std::make_unique<Loaded>(Loaded{std::move(prepared), {}, 0});
    loaded->uploads.reserve(loaded->artifact.data.size());
    for (LevelData& data : loaded->artifact.data) {
        loaded->uploads.emplace_back(std::move(data));
    }
    loaded->artifact.data.clear();
    records_[artifact].bytes = loaded->artifact.levels.bytes();
    records_[artifact].loaded = true;
    loaded_[artifact] = std::move(loaded);
}

/// The most urgent one that has come and is not ready; what nobody wants any more goes on last.
void Residents::upload(GpuStore& store, std::size_t shown, std::span<const std::size_t> wanted) {
    const auto arrives = [&](std::size_t artifact) {
        return loaded_[artifact] && !loaded_[artifact]->ready();
    };
    std::optional<std::size_t> next;
    if (arrives(shown)) {
        next = shown;
    }
    for (std::size_t k = 0; k < wanted.size() && !next; ++k) {
        next = arrives(wanted[k]) ? std::optional(wanted[k]) : std::nullopt;
    }
    for (std::size_t k = 0; k < loaded_.size() && !next; ++k) {
        next = arrives(k) ? std::optional(k) : std::nullopt;
    }
    if (!next) {
        return;
    }
    const bool urgent = *next == shown || (!wanted.empty() && *next == wanted.front());
    if (const Result<void> done = upload(store, *next, urgent ? urgent_bytes : early_bytes); !done) {
        const std::string reason = set_up_.artifacts[*next].file.string() + ": " + done.error().message;
        say_line(set_up_.program, fmt::format("left out: {}", reason));
        release(store, *next);
        leave_out(*next, reason);
    }
}

Result<void> Residents::upload(GpuStore& store, std::size_t artifact, std::uint64_t most_bytes) {
    Loaded& loaded = *loaded_[artifact];
    LevelUpload& level = loaded.uploads[loaded.uploaded];
    if (Result<void> gone_on = level.go_on(most_bytes); !gone_on) {
        return gone_on;
    }
    if (level.done()) {
        loaded.artifact.levels.give(loaded.uploaded, store.keep(std::move(level)), store);
        ++loaded.uploaded;
    }
    if (loaded.ready()) {
        states_[artifact] = ArtifactState::Ready;
    }
    return {};
}

void Residents::release(GpuStore& store, std::size_t artifact) {
    const LevelState state = loaded_[artifact]->artifact.levels.state();
    past_switches_ += state.switches;
    past_ignored_times_ += state.ignored_times;
    loaded_[artifact]->artifact.levels.release(store);
    loaded_[artifact].reset();
    records_[artifact].loaded = false;
    states_[artifact] = ArtifactState::Away;
}

void Residents::leave_out(std::size_t artifact, const std::string& reason) {
    records_[artifact].left_out = true;
    states_[artifact] = ArtifactState::LeftOut;
    left_out_.push_back(pack_left_out(set_up_.artifacts[artifact].file.string(), reason));
}

RunLevels* Residents::find(std::size_t artifact) {
    return states_[artifact] == ArtifactState::Ready ? &loaded_[artifact]->artifact.levels : nullptr;
}

const RunLevels* Residents::find(std::size_t artifact) const {
    return const_cast<Residents*>(this)->find(artifact);
}

double Residents::exposure(std::size_t artifact) const {
    return loaded_[artifact] ? loaded_[artifact]->artifact.exposure : 1.0;
}

ArtifactTriangles Residents::triangles(std::size_t artifact) const {
    return find(artifact) != nullptr ? loaded_[artifact]->artifact.triangles : ArtifactTriangles{};
}

std::size_t Residents::ready() const {
    return static_cast<std::size_t>(std::count(states_.begin(), states_.end(), ArtifactState::Ready));
}

std::uint64_t Residents::bytes() const {
    return std::accumulate(records_.begin(), records_.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const ResidentArtifact& artifact) {
                               return sum + (artifact.loaded ? artifact.bytes : 0);
                           });
}

std::uint64_t Residents::switches() const {
    return std::accumulate(loaded_.begin(), loaded_.end(), past_switches_,
                           [](std::uint64_t sum, const auto& each) {
                               return sum + (each ? each->artifact.levels.state().switches : 0);
                           });
}

std::uint64_t Residents::ignored_times() const {
    return std::accumulate(loaded_.begin(), loaded_.end(), past_ignored_times_,
                           [](std::uint64_t sum, const auto& each) {
                               return sum + (each ? each->artifact.levels.state().ignored_times : 0);
                           });
}

} // namespace frustumscreen

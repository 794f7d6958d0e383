#include "app/residency/artifact_reader.h"

#include "firmware_host/base/device_thread.h"

#include <utility>

namespace frustumscreen::residency {

ArtifactReader::ArtifactReader(Prepare prepare) : prepare_(std::move(prepare)), thread_([this] { work(); }) {}

ArtifactReader::~ArtifactReader() {
    wanted_ = the_end;
    wanted_.notify_one();
    thread_.join();
    delete answer_.load();
}

void ArtifactReader::request(std::optional<std::size_t> item) {
    const std::uint32_t wanted = item ? static_cast<std::uint32_t>(*item) : nothing;
    if (wanted_.exchange(wanted) != wanted) {
        wanted_.notify_one();
    }
}

std::unique_ptr<ArtifactReader::Answer> ArtifactReader::take() {
    return std::unique_ptr<Answer>(answer_.exchange(nullptr));
}

void ArtifactReader::work() {
    begin_device_thread("artifacts", ThreadPriority::Low);
    while (true) {
        wanted_.wait(nothing);
        const std::uint32_t item = wanted_;
        if (item == the_end) {
            return;
        }
        if (item == nothing) {
            continue;
        }
        bool gave_up = false; // permanent: an equal request may have returned in between
        auto answer = std::make_unique<Answer>(Answer{item, prepare_(item, [&] {
                                                          gave_up = gave_up || wanted_ != item;
                                                          return gave_up;
                                                      })});
        if (gave_up || wanted_ != item) {
            continue;
        }
        delete answer_.exchange(answer.release());
        std::uint32_t still = item;
        wanted_.compare_exchange_strong(still, nothing); // done, unless another request has arrived
    }
}

} // namespace frustumscreen::residency

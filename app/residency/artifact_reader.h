/// A thread that reads and prepares one thing after the other, an artifact or some of its texts, so that the render thread
/// never does.
///
/// The render thread says which one it wants, by a number, and finds it ready some frames later. Neither waits for the other:
/// a lock that a thread of low priority holds could stop the picture.
///
/// Threads  `request` and `take` from one thread; they neither wait nor read a file. `prepare` runs on the reader's
///          own, which has a low priority: it takes what the picture leaves.
/// Errors   those of `prepare`, as an answer.
#pragma once

#include "app/residency/prepared_artifact.h"
#include "firmware_host/base/result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <variant>

namespace frustumscreen {

class ArtifactReader {
public:
    using Prepared = std::variant<TextPictures, PreparedArtifact>;
    /// Whether it is no longer wanted: then `prepare` may return anything, soon.
    using GivenUp = std::function<bool()>;
    using Prepare = std::function<Result<Prepared>(std::size_t item, const GivenUp& given_up)>;
    struct Answer {
        std::size_t item = 0;
        Result<Prepared> prepared;
    };

    /// Starts the thread.
    explicit ArtifactReader(Prepare prepare);
    /// Gives up what is being read, and waits for that.
    ~ArtifactReader();
    ArtifactReader(const ArtifactReader&) = delete;
    ArtifactReader& operator=(const ArtifactReader&) = delete;

    /// What to prepare, or nothing; anything else is given up. Asked for again after its answer was taken, it is prepared
    /// again.
    void request(std::optional<std::size_t> item);
    /// What was prepared, once; perhaps of a request before the latest.
    [[nodiscard]] std::unique_ptr<Answer> take();

private:
    void work();

    /// What is wanted, or one of these.
    static constexpr std::uint32_t nothing = ~std::uint32_t{0};
    static constexpr std::uint32_t the_end = nothing - 1;

    Prepare prepare_;
    std::atomic<std::uint32_t> wanted_{nothing};
    std::atomic<Answer*> answer_{nullptr}; ///< owned by who takes it out
    std::jthread thread_;                  ///< last: it uses the others
};

} // namespace frustumscreen

// Time of an import, compared with a plain copy and sync of the same bytes, from a stick of 30 MB/s; docs/sticks.md
// has figures.
//
//   stick_time MB [PACKS]      in a new folder of the current one, which is removed afterwards
//
// The stick is a folder whose bytes come as from a device with the kernel's read-ahead: the device reads on by
// itself, but at most 128 KiB beyond the request.
#include "app/library/import_stick.h"
#include "firmware_host/base/disk_tree.h"
#include "tests/library/museum.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace frustumscreen::library {
namespace {

using testing_disk::Museum;

constexpr double bytes_per_s = 30e6;
constexpr double read_ahead_bytes = 128.0 * 1024.0;

/// A device that reads ahead: computes when the next bytes are ready.
class Device {
public:
    void wait_for(std::size_t bytes) {
        const double now = to_seconds(monotonic_now().time_since_epoch());
        // The device was idle once it was as far ahead as it may be.
        ready_s_ = std::max(ready_s_, now - read_ahead_bytes / bytes_per_s) +
                   static_cast<double>(bytes) / bytes_per_s;
        if (ready_s_ > now) {
            std::this_thread::sleep_for(std::chrono::duration<double>(ready_s_ - now));
        }
    }

private:
    double ready_s_ = 0.0;
};

class SlowContent final : public FileContent {
public:
    SlowContent(std::unique_ptr<const FileContent> content, Device& device)
        : content_(std::move(content)), device_(device) {}
    [[nodiscard]] std::uint64_t bytes() const override { return content_->bytes(); }
    [[nodiscard]] int read(std::uint64_t offset, std::span<std::byte> out) const override {
        device_.wait_for(out.size());
        return content_->read(offset, out);
    }

private:
    std::unique_ptr<const FileContent> content_;
    Device& device_;
};

class SlowTree final : public FileTree {
public:
    explicit SlowTree(FileTree& tree) : tree_(tree) {}
    FileResult<void> list(const std::string& folder,
                          const std::function<bool(const FolderEntry&)>& visit) override {
        return tree_.list(folder, visit);
    }
    FileResult<std::unique_ptr<const FileContent>> open(const std::string& path) override {
        FileResult<std::unique_ptr<const FileContent>> content = tree_.open(path);
        if (!content) {
            return content;
        }
        return std::make_unique<SlowContent>(*std::move(content), device_);
    }

private:
    FileTree& tree_;
    Device device_;
};

/// Copies like cp, in pieces of 128 KiB, then syncs.
void copy_all(FileTree& from, WritableTree& to, int packs) {
    Bytes piece;
    for (int k = 0; k < packs; ++k) {
        const std::string name = fmt::format("{}.fspack", k);
        const auto source = from.open(name).value();
        const auto target = to.create(name).value();
        for (std::uint64_t at = 0; at < source->bytes(); at += piece.size()) {
            piece.resize(std::min<std::uint64_t>(128U << 10U, source->bytes() - at));
            if (source->read(at, piece) != 0 || !target->append(piece)) {
                std::abort();
            }
        }
    }
    ::sync();
}

struct Times {
    double clock_s = 0.0;
    double processor_s = 0.0;
};
Times times_of(const std::function<void()>& work) {
    ::sync();
    const MonotonicTime began = monotonic_now();
    const std::clock_t processor_began = std::clock();
    work();
    return {to_seconds(monotonic_now() - began),
            static_cast<double>(std::clock() - processor_began) / CLOCKS_PER_SEC};
}

int measure(std::size_t megabytes, int packs) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::current_path() / fmt::format("stick_time_{}", ::getpid());
    for (const std::string name : {"stick", "copy", "library"}) {
        fs::create_directories(folder / name);
    }
    const Museum museum;
    for (int k = 0; k < packs; ++k) {
        const std::size_t bytes = megabytes * 1000000 / static_cast<std::size_t>(packs);
        const Bytes pack = museum.pack(fmt::format("id-{}", k), 1, bytes);
        if (!write_file(folder / "stick" / fmt::format("{}.fspack", k), pack)) {
            return 1;
        }
    }
    const auto stick = open_tree(folder / "stick").value();
    const auto copy = open_tree(folder / "copy").value();
    const auto library = open_tree(folder / "library").value();
    SlowTree slow(*stick);
    SlowTree as_slow(*stick);
    const Times copied = times_of([&] { copy_all(slow, *copy, packs); });
    ImportRequest request = testing_disk::request_of(museum);
    request.limits.step_bytes = ImportLimits().step_bytes;
    ImportEnvironment outside = testing_disk::quiet_environment();
    outside.now = monotonic_now;
    ImportStage stage = ImportStage::Failed;
    const Times imported = times_of([&] { stage = import_stick(as_slow, *library, request, outside).stage; });
    fmt::print("{} MB in {} packs: copy and sync {:.2f} s ({:.2f} s of the processor), import {:.2f} s "
               "({:.2f} s), ratio "
               "{:.2f}{}\n",
               megabytes, packs, copied.clock_s, copied.processor_s, imported.clock_s, imported.processor_s,
               imported.clock_s / copied.clock_s, stage == ImportStage::Done ? "" : " FAILED");
    fs::remove_all(folder);
    return stage == ImportStage::Done ? 0 : 1;
}

} // namespace
} // namespace frustumscreen::library

int main(int argc, char** argv) {
    return frustumscreen::measure(argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100,
                                  argc > 2 ? std::atoi(argv[2]) : 1);
}

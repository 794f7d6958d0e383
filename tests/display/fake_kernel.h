/// A fake kernel for graphics cards: their files, the calls of libdrm and libgbm, mapped memory. While an
/// instance lives (with several, the last one), the tested code's calls of libdrm and libgbm, and of `open`,
/// `close`, `mmap` and `munmap`, go to fake_libdrm.cpp, fake_libgbm.cpp and fake_files.cpp.
///
/// It counts everything that it hands out, and each call may be set to fail. libdrm repeats calls that a
/// signal interrupts (drmIoctl in xf86drm.c), so it never returns EINTR or EAGAIN; `open` and `poll` do.
///
/// Threads  one.
/// Source   xf86drm.c, xf86drmMode.c of libdrm 2.4.114 for return values; drm_auth.c, drm_ioctl.c of Linux
///          6.1 for permissions: EACCES without being master, ENODEV for a card that was pulled out.
#pragma once

#include "tests/display/fake_card.h"

#include <string_view>

namespace frustumscreen::display {

/// A renderer.
struct FakeGpu {
    std::string path;       ///< of its render node; empty: none
    std::string renderer;   ///< its name in OpenGL; empty: the processor draws
    FakeCard* of = nullptr; ///< the card that contains it
};

class FakeKernel {
public:
    FakeKernel();
    ~FakeKernel();
    FakeKernel(const FakeKernel&) = delete;
    FakeKernel& operator=(const FakeKernel&) = delete;
    static FakeKernel& instance();
    static bool is_there();

    FakeCard& add_card(const std::string& path);
    void add_gpu(FakeGpu gpu) { gpus_.push_back(std::move(gpu)); }

    /// The names of all calls so far; `fail` makes the call of this number fail with this error number.
    [[nodiscard]] const std::vector<std::string>& calls() const { return calls_; }
    void fail(std::size_t call, int error) { failing_ = {call, error}; }
    /// From now on, each call of this name fails; 0: ends this.
    void fail_always(const std::string& name, int error) { refused_[name] = error; }
    /// The error numbers that this call can return.
    [[nodiscard]] static std::vector<int> errors_of(std::string_view call);

    /// Describes everything that was handed out and not returned; empty: nothing.
    [[nodiscard]] std::string alive() const;
    /// Describes objects left when a card's file was closed, and objects returned twice; empty: none.
    [[nodiscard]] const std::string& wrongs() const { return wrongs_; }

    // Used by the replaced functions.
    /// The error number; 0: the call proceeds.
    [[nodiscard]] int enter(std::string_view call);
    [[nodiscard]] FakeFile* file(int number);
    [[nodiscard]] FakeCard* card_at(std::string_view path);
    [[nodiscard]] const FakeGpu* gpu_at(std::string_view path) const;
    [[nodiscard]] const std::vector<FakeGpu>& gpus() const { return gpus_; }
    /// True for a card, false for a GPU.
    int open_file(FakeCard* card, const FakeGpu* gpu, int flags);
    /// A lease's file; a negative error number if it is refused.
    int lease(FakeFile& lessor, std::span<const std::uint32_t> objects);
    void close_file(int number);
    void hand_out(const void* what, std::string kind, std::shared_ptr<void> memory = nullptr);
    void give_back(const void* what, std::string_view kind);
    [[nodiscard]] bool handed_out(const void* what) const { return handed_out_.contains(what); }

private:
    struct HandedOut {
        std::string kind;
        std::shared_ptr<void> memory;
    };
    FakeKernel* before_;
    std::map<std::string, std::unique_ptr<FakeCard>, std::less<>> cards_;
    std::vector<FakeGpu> gpus_;
    std::map<int, FakeFile> files_;
    std::map<const void*, HandedOut> handed_out_;
    std::vector<std::string> calls_;
    std::pair<std::size_t, int> failing_{0, 0};
    std::map<std::string, int, std::less<>> refused_;
    std::string wrongs_;
};

} // namespace frustumscreen::display

/// The kernel below a test's program, as far as graphics cards go: their files, the calls of libdrm and libgbm, memory that is mapped.
/// While one of these lives (of several, the last), the functions of libdrm and libgbm, and `open`, `close`, `mmap` and `munmap`, that the tested code calls
/// are those of fake_libdrm.cpp, fake_libgbm.cpp and fake_files.cpp.
///
/// It counts all that it hands out, and each call may be told to fail. An error that a signal causes (EINTR, EAGAIN) does not
/// leave libdrm, which repeats the call (drmIoctl in xf86drm.c); that of `open` and `poll` does.
///
/// Threads  one.
/// Source   xf86drm.c, xf86drmMode.c of libdrm 2.4.114 for what a function returns; drm_auth.c, drm_ioctl.c of Linux 6.1 for who may
///          call: without being master EACCES, of a card that was pulled out ENODEV.
#pragma once

#include "tests/display/fake_card.h"

#include <string_view>

namespace frustumscreen {

/// Something that draws.
struct FakeGpu {
    std::string path;       ///< of its render node; empty: it has none
    std::string renderer;   ///< what OpenGL says of it; empty: the processor draws
    FakeCard* of = nullptr; ///< the card that it is part of
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

    /// The calls so far, by name; the one of this number fails with this error number.
    [[nodiscard]] const std::vector<std::string>& calls() const { return calls_; }
    void fail(std::size_t call, int error) { failing_ = {call, error}; }
    /// From now on, each call of this name fails; 0: no longer.
    void fail_always(const std::string& name, int error) { refused_[name] = error; }
    /// The error numbers that this call is known to give.
    [[nodiscard]] static std::vector<int> errors_of(std::string_view call);

    /// All that was handed out and not given back, in words; empty: nothing.
    [[nodiscard]] std::string alive() const;
    /// What was still there when a card's file was closed, and what was given back twice; empty: nothing.
    [[nodiscard]] const std::string& wrongs() const { return wrongs_; }

    // For the functions that it replaces.
    /// An error number, 0: the call goes on.
    [[nodiscard]] int enter(std::string_view call);
    [[nodiscard]] FakeFile* file(int number);
    [[nodiscard]] FakeCard* card_at(std::string_view path);
    [[nodiscard]] const FakeGpu* gpu_at(std::string_view path) const;
    [[nodiscard]] const std::vector<FakeGpu>& gpus() const { return gpus_; }
    /// Of a card, or else of a GPU.
    int open_file(FakeCard* card, const FakeGpu* gpu, int flags);
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

} // namespace frustumscreen

#include "firmware_host/service/crash_record.h"

#include "firmware_host/base/crash_file.h"
#include "firmware_host/base/this_boot.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <ucontext.h>
#include <unistd.h>
#include <unwind.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <span>
#include <string>

namespace frustumscreen::service {

namespace {

struct CrashSignal {
    int number;
    const char* name;
    const char* sentence;
};
constexpr std::array<CrashSignal, 5> crash_signals{{
    {SIGSEGV, "SIGSEGV", "memory that is not there"},
    {SIGBUS, "SIGBUS", "memory or a file's page that cannot be read"},
    {SIGILL, "SIGILL", "an instruction that this processor does not have"},
    {SIGFPE, "SIGFPE", "arithmetic that cannot be done"},
    {SIGABRT, "SIGABRT", "the program ended itself after an error, or was told to"},
}};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_sanitizer = true;
#else
constexpr bool has_sanitizer = false;
#endif

constexpr std::size_t max_frames = 48;
constexpr std::size_t max_stack_words = 256; ///< to search if the unwinder stops at compiled code
constexpr std::size_t max_guesses = 6;
constexpr std::size_t min_unwound = 3; ///< fewer frames mean that the unwinder stopped early
constexpr unsigned max_handler_s = 3;

/// An address and its module.
struct Place {
    std::uintptr_t address = 0;
    std::uintptr_t offset = 0;
    std::array<char, 48> module{}; ///< empty: no file
    bool executable = false;
};

/// Memory for the handler, reserved in advance.
struct State {
    std::array<char, 512> file{};
    std::array<char, 64> boot{};
    std::array<char, 64> program{};
    std::array<char, 256> system{};
    std::array<char, 256> driver{};
    std::array<Place, max_frames + max_stack_words> places{};
    std::size_t unwound = 0; ///< of `places`; later entries are words of the stack
    std::size_t count = 0;
    std::array<char, 8192> text{};
    std::size_t length = 0;
};
State state;                           // global, because a handler has no parameters for it
std::array<char, 65536> handler_stack; // alternate stack, needed after a stack overflow
std::atomic_flag is_writing = ATOMIC_FLAG_INIT;

template <std::size_t size> void keep(std::array<char, size>& place, std::string_view text) {
    const std::size_t length = std::min(text.size(), size - 1);
    std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length), place.begin(),
                   [](char each) { return each == '\n' || each == '\r' ? ' ' : each; });
    place[length] = '\0';
}

// From here to `handle`: only async-signal-safe code.

void add(std::string_view text) {
    const std::size_t fits = std::min(text.size(), state.text.size() - state.length);
    std::memcpy(state.text.data() + state.length, text.data(), fits);
    state.length += fits;
}

void add_number(std::uint64_t value, unsigned base = 10) {
    std::array<char, 24> digits{};
    std::size_t first = digits.size();
    do {
        digits[--first] = "0123456789abcdef"[value % base];
        value /= base;
    } while (value != 0);
    add({&digits[first], digits.size() - first});
}

void add_line(std::string_view key, const char* value) {
    if (value[0] != '\0') {
        add(key);
        add(value);
        add("\n");
    }
}

struct Registers {
    std::uintptr_t code = 0, stack = 0; ///< addresses
};
Registers registers_of(const void* context) {
    const auto& machine = static_cast<const ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
    return {static_cast<std::uintptr_t>(machine.gregs[REG_RIP]),
            static_cast<std::uintptr_t>(machine.gregs[REG_RSP])};
#else
    return {static_cast<std::uintptr_t>(machine.pc), static_cast<std::uintptr_t>(machine.sp)};
#endif
}

_Unwind_Reason_Code take_frame(_Unwind_Context* frame, void* /*unused*/) {
    if (state.unwound == max_frames) {
        return _URC_END_OF_STACK;
    }
    state.places[state.unwound++].address = _Unwind_GetIP(frame);
    return _URC_NO_REASON;
}

/// Collects the frames from the crash outwards, without the handler's own.
void unwind(std::uintptr_t crashed_at) {
    state.unwound = 0;
    _Unwind_Backtrace(take_frame, nullptr);
    std::size_t first = 0;
    while (first < state.unwound && state.places[first].address != crashed_at) {
        ++first;
    }
    if (first == state.unwound) {
        state.places[0].address = crashed_at;
        state.unwound = 1;
        return;
    }
    for (std::size_t k = first; k < state.unwound; ++k) {
        state.places[k - first].address = state.places[k].address;
    }
    state.unwound -= first;
}

/// Collects words of the stack that may be return addresses, from the stack pointer up to `end`.
void take_stack(std::uintptr_t from, std::uintptr_t end) {
    for (std::uintptr_t at = from & ~std::uintptr_t{7};
         at + 8 <= end && state.count < state.unwound + max_stack_words; at += 8) {
        // Reads raw stack memory. NOLINTNEXTLINE(performance-no-int-to-ptr)
        std::memcpy(&state.places[state.count++].address, reinterpret_cast<const void*>(at), 8);
    }
}

/// One mapping of /proc/self/maps.
struct Mapping {
    std::uintptr_t begin = 0, end = 0, offset = 0;
    bool executable = false;
    std::string_view file; ///< without its folder
};

Mapping parse_mapping(std::string_view line) {
    const auto hex = [&line] {
        std::uintptr_t value = 0;
        std::size_t k = 0;
        for (; k < line.size(); ++k) {
            const char c = line[k];
            const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
            if (digit < 0) {
                break;
            }
            value = value * 16 + static_cast<std::uintptr_t>(digit);
        }
        line.remove_prefix(std::min(k + 1, line.size())); // the number and the following character
        return value;
    };
    Mapping mapping;
    mapping.begin = hex();
    mapping.end = hex();
    mapping.executable = line.size() > 2 && line[2] == 'x';
    line.remove_prefix(std::min<std::size_t>(5, line.size()));
    mapping.offset = hex();
    if (const std::size_t slash = line.rfind('/'); slash != std::string_view::npos) {
        mapping.file = line.substr(slash + 1);
    }
    return mapping;
}

/// Calls `visit` for each mapping of the process.
template <typename Visit> void for_each_mapping(const Visit& visit) {
    static std::array<char, 4096> buffer;
    const int maps = ::open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
    std::size_t held = 0;
    for (ssize_t count = 0;
         maps >= 0 && (count = ::read(maps, buffer.data() + held, buffer.size() - held)) > 0;) {
        held += static_cast<std::size_t>(count);
        std::string_view rest(buffer.data(), held);
        for (std::size_t end = 0; (end = rest.find('\n')) != std::string_view::npos;) {
            visit(parse_mapping(rest.substr(0, end)));
            rest.remove_prefix(end + 1);
        }
        held = rest.size() < buffer.size() ? rest.size() : 0; // drop a line that fills the buffer
        std::memmove(buffer.data(), rest.data(), held);
    }
    ::close(maps);
}

/// Offsets count from the mapping of the module's first byte, as addr2line expects.
void find_modules() {
    std::uintptr_t base = 0;
    for_each_mapping([&base](const Mapping& mapping) {
        base = mapping.offset == 0 ? mapping.begin : base;
        for (Place& place : std::span(state.places).first(state.count)) {
            if (place.address >= mapping.begin && place.address < mapping.end) {
                keep(place.module, mapping.file);
                place.offset = place.address - base;
                place.executable = mapping.executable;
            }
        }
    });
}

void add_place(std::string_view key, const Place& place) {
    add(key);
    add(place.module[0] != '\0' ? place.module.data() : "compiled");
    add("+0x");
    add_number(place.module[0] != '\0' ? place.offset : place.address, 16);
    add("\n");
}

void add_places(const void* context) {
    const auto [code, stack] = registers_of(context);
    unwind(code);
    state.count = state.unwound;
    if (state.unwound < min_unwound) {
        std::uintptr_t end = 0;
        for_each_mapping([&end, stack = stack](const Mapping& mapping) {
            end = stack >= mapping.begin && stack < mapping.end ? mapping.end : end;
        });
        take_stack(stack, end);
    }
    find_modules();
    for (std::size_t k = 0; k < state.unwound; ++k) {
        add_place("frame ", state.places[k]);
    }
    std::size_t guesses = 0;
    for (std::size_t k = state.unwound; k < state.count && guesses < max_guesses; ++k) {
        if (state.places[k].executable && state.places[k].module[0] != '\0') {
            add_place("guess ", state.places[k]);
            ++guesses;
        }
    }
}

std::uint64_t clock_of(clockid_t clock, std::uint64_t per_s) {
    std::timespec time{};
    ::clock_gettime(clock, &time);
    const auto seconds = static_cast<std::uint64_t>(std::max<std::time_t>(time.tv_sec, 0));
    return seconds * per_s + static_cast<std::uint64_t>(time.tv_nsec) * per_s / 1'000'000'000U;
}

void write_file(const CrashSignal& crash, const void* context) {
    std::array<char, 20> thread{};
    ::prctl(PR_GET_NAME, thread.data());
    state.length = 0;
    add(crash_file_begin);
    add("\nunix_s ");
    add_number(clock_of(CLOCK_REALTIME, 1));
    add("\nmonotonic_ms ");
    add_number(clock_of(CLOCK_MONOTONIC, 1000));
    add("\n");
    add_line("boot ", state.boot.data());
    add_line("signal ", crash.name);
    add_line("thread ", thread.data());
    add_line("program ", state.program.data());
    add_line("system ", state.system.data());
    add_line("driver ", state.driver.data());
    add_places(context);
    add("end\n");
    const int file = ::open(state.file.data(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file >= 0) {
        [[maybe_unused]] const ssize_t written = ::write(file, state.text.data(), state.length);
        ::fsync(file);
        ::close(file);
    }
}

void say_last_line(const CrashSignal& crash) {
    state.length = 0;
    add("frustumscreen: crashed: ");
    add(crash.sentence);
    add(" (");
    add(crash.name);
    add(")\n");
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, state.text.data(), state.length);
}

extern "C" void handle(int signal, siginfo_t* /*info*/, void* context) {
    while (is_writing.test_and_set()) {
        ::pause(); // another thread writes, and ends the process
    }
    ::signal(SIGALRM, SIG_DFL);
    sigset_t alarm;
    ::sigemptyset(&alarm);
    ::sigaddset(&alarm, SIGALRM);
    ::pthread_sigmask(SIG_UNBLOCK, &alarm, nullptr);
    ::alarm(max_handler_s);
    const auto* const crash =
        std::find_if(crash_signals.begin(), crash_signals.end(),
                     [signal](const CrashSignal& each) { return each.number == signal; });
    if (crash != crash_signals.end()) {
        say_last_line(*crash);
        if (state.file[0] != '\0') {
            write_file(*crash, context);
        }
    }
    ::signal(signal, SIG_DFL);
    ::raise(signal); // blocked until this handler returns; then it ends the process
}

/// A free slot, otherwise the oldest.
std::filesystem::path next_file(const std::filesystem::path& folder) {
    std::filesystem::path oldest;
    std::filesystem::file_time_type oldest_at;
    for (int k = 1; k <= crash_file_count; ++k) {
        const std::filesystem::path file = folder / crash_file_name(k);
        std::error_code missing;
        const auto at = std::filesystem::last_write_time(file, missing);
        if (missing) {
            return file;
        }
        if (oldest.empty() || at < oldest_at) {
            oldest = file;
            oldest_at = at;
        }
    }
    return oldest;
}

} // namespace

void record_crashes(const CrashRecordSetUp& set_up) {
    if (has_sanitizer) {
        return;
    }
    if (!set_up.folder.empty()) {
        std::error_code failed; // the file cannot be opened then either
        std::filesystem::create_directories(set_up.folder, failed);
        keep(state.file, next_file(set_up.folder).native());
    }
    keep(state.boot, boot_id());
    keep(state.program, set_up.program);
    keep(state.system, set_up.system);
    state.unwound = 0;
    _Unwind_Backtrace(take_frame, nullptr); // the first call loads libraries
    stack_t stack{};
    stack.ss_sp = handler_stack.data();
    stack.ss_size = handler_stack.size();
    ::sigaltstack(&stack, nullptr);
    for (const CrashSignal& each : crash_signals) {
        struct sigaction action {};
        action.sa_sigaction = handle;
        action.sa_flags = SA_SIGINFO | SA_ONSTACK;
        ::sigaction(each.number, &action, nullptr);
    }
}

void note_driver_for_crashes(std::string_view driver) {
    keep(state.driver, driver);
}

} // namespace frustumscreen::service

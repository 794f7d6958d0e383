// What the leak checker passes over. Pango 1.50 asks fontconfig for typefaces on threads of its own, which nobody waits for:
// what they hold when a test ends was not lost by us.
extern "C" const char* __lsan_default_suppressions();

extern "C" const char* __lsan_default_suppressions() {
    return "leak:libfontconfig\n";
}

// What the leak check of programs that draw must know of Mesa, whose driver is loaded at run time:
// thread-local memory of a library that comes and goes is misread by the check itself, which then crashes.
// Without it, what the dynamic loader and OpenMP keep in there for good would count as lost.
#if defined(__SANITIZE_ADDRESS__)

extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_suppressions();

const char* __lsan_default_options() { return "use_tls=0:print_suppressions=0"; }
const char* __lsan_default_suppressions() { return "leak:ld-linux\nleak:libgomp\n"; }

#endif

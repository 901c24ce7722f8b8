// Linked into every program of the sanitizer presets: reports about Debian's own libraries that are
// not ours to fix. Never a race inside our code or OpenCV's images.

extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  // GDAL, behind OpenCV's image files, takes two of its own locks in both orders; CHOLMOD, behind
  // Ceres, uses OpenMP, whose barriers the sanitizer does not see.
  return "deadlock:libgdal.so\nrace:libcholmod.so\nrace:libgomp.so\n";
}

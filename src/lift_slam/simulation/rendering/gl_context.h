#pragma once

namespace lift_slam {

// An OpenGL 4.5 core context without screen or window: surfaceless EGL, which Mesa serves in
// software (llvmpipe). Not thread-safe itself, but contexts are independent of one another.
class GlContext {
 public:
  // Throws InputError naming the Debian packages when no such context can be had.
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  // Makes the context current in the calling thread for as long as it lives: OpenGL calls need it.
  class Scope {
   public:
    explicit Scope(const GlContext& context);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    void* display_;
  };

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace lift_slam

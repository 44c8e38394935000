#include "sim/camera/gl.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string>

#include "base/fault.hpp"

namespace mrroc::camera {
namespace {

// Mesa draws with one thread per context: every camera has a thread already. It reads that once, and the
// environment must not change while other threads look at it; so it is set before main().
const bool kOneThread = ::setenv("LP_NUM_THREADS", "1", 0) == 0;

[[noreturn]] void refuse(const std::string& why) { throw FaultError(FaultCode::no_renderer, why); }

/// The functions of EGL, and the one display that all contexts share; it lives as long as the process.
class Egl {
 public:
  static const Egl& instance() {
    static const Egl egl;
    return egl;
  }

  decltype(&::eglGetProcAddress) GetProcAddress{};
  decltype(&::eglInitialize) Initialize{};
  decltype(&::eglBindAPI) BindAPI{};
  decltype(&::eglChooseConfig) ChooseConfig{};
  decltype(&::eglCreateContext) CreateContext{};
  decltype(&::eglDestroyContext) DestroyContext{};
  decltype(&::eglMakeCurrent) MakeCurrent{};
  EGLDisplay display{};

 private:
  Egl() {
    library_ = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library_ || !kOneThread) refuse("libEGL.so.1 cannot be loaded");
    load(GetProcAddress, "eglGetProcAddress");
    load(Initialize, "eglInitialize");
    load(BindAPI, "eglBindAPI");
    load(ChooseConfig, "eglChooseConfig");
    load(CreateContext, "eglCreateContext");
    load(DestroyContext, "eglDestroyContext");
    load(MakeCurrent, "eglMakeCurrent");
    const auto get =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(GetProcAddress("eglGetPlatformDisplayEXT"));
    if (!get) refuse("EGL has no platforms");
    display = get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    EGLint major{};
    EGLint minor{};
    if (!display || !Initialize(display, &major, &minor))
      refuse("Mesa's EGL does not start without a display");
  }

  template <class Function>
  void load(Function& function, const char* name) {
    function = reinterpret_cast<Function>(::dlsym(library_, name));
    if (!function) refuse(std::string("libEGL.so.1 has no ") + name);
  }

  void* library_{};
};

EGLContext make_context(const Egl& egl) {
  if (!egl.BindAPI(EGL_OPENGL_API)) refuse("EGL has no OpenGL");
  constexpr std::array<EGLint, 5> kKind{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config{};
  EGLint n{};
  egl.ChooseConfig(egl.display, kKind.data(), &config, 1, &n);
  constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
  const EGLContext context =
      egl.CreateContext(egl.display, n > 0 ? config : nullptr, EGL_NO_CONTEXT, kVersion.data());
  if (!context) refuse("EGL gives no context of OpenGL 3.3");
  return context;
}

template <class Function>
void load(const Egl& egl, Function& function, const char* name) {
  function = reinterpret_cast<Function>(egl.GetProcAddress(name));
  if (!function) refuse(std::string("OpenGL has no ") + name);
}

}  // namespace

GlContext::GlContext() : context_(make_context(Egl::instance())) {
  const Egl& egl = Egl::instance();
#define MRROC_GL_LOAD(name, type) load(egl, gl_.name, "gl" #name);
  MRROC_GL_FUNCTIONS(MRROC_GL_LOAD)
#undef MRROC_GL_LOAD
}

GlContext::~GlContext() { Egl::instance().DestroyContext(Egl::instance().display, context_); }

GlContext::Use::Use(GlContext& context) : context_(context) {
  const Egl& egl = Egl::instance();
  egl.BindAPI(EGL_OPENGL_API);  // a property of the thread
  if (!egl.MakeCurrent(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_.context_))
    refuse("the context of OpenGL cannot be used in this thread");
}

GlContext::Use::~Use() {
  const Egl& egl = Egl::instance();
  egl.MakeCurrent(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace mrroc::camera

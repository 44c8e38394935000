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

// Each camera has a thread that draws; with threads of Mesa's own besides, which serve all of them, nothing is gained.
// It reads their number once, and the environment must not change while other threads look at it: so it is set before
// main().
const bool kDrawsItself = ::setenv("LP_NUM_THREADS", "0", 0) == 0;

[[noreturn]] void refuse(const std::string& why) { throw FaultError(FaultCode::no_renderer, why); }

/// The functions of EGL, and the one display that all contexts share; it lives as long as the process.
class Egl {
 public:
  static const Egl& instance() {
    static const Egl egl;
    return egl;
  }

  decltype(&::eglGetProcAddress) get_proc_address{};
  decltype(&::eglInitialize) initialize{};
  decltype(&::eglBindAPI) bind_api{};
  decltype(&::eglChooseConfig) choose_config{};
  decltype(&::eglCreateContext) create_context{};
  decltype(&::eglDestroyContext) destroy_context{};
  decltype(&::eglMakeCurrent) make_current{};
  EGLDisplay display{};

 private:
  Egl() {
    library_ = ::dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library_ || !kDrawsItself) refuse("libEGL.so.1 cannot be loaded");
    load(get_proc_address, "eglGetProcAddress");
    load(initialize, "eglInitialize");
    load(bind_api, "eglBindAPI");
    load(choose_config, "eglChooseConfig");
    load(create_context, "eglCreateContext");
    load(destroy_context, "eglDestroyContext");
    load(make_current, "eglMakeCurrent");
    const auto get =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(get_proc_address("eglGetPlatformDisplayEXT"));
    if (!get) refuse("EGL has no platforms");
    display = get(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    EGLint major{};
    EGLint minor{};
    if (!display || !initialize(display, &major, &minor))
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
  if (!egl.bind_api(EGL_OPENGL_API)) refuse("EGL has no OpenGL");
  constexpr std::array<EGLint, 5> kKind{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config{};
  EGLint n{};
  egl.choose_config(egl.display, kKind.data(), &config, 1, &n);
  constexpr std::array<EGLint, 7> kVersion{EGL_CONTEXT_MAJOR_VERSION,
                                           3,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           3,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
  EGLContext context =
      egl.create_context(egl.display, n > 0 ? config : nullptr, EGL_NO_CONTEXT, kVersion.data());
  if (!context) refuse("EGL gives no context of OpenGL 3.3");
  return context;
}

template <class Function>
void load(const Egl& egl, Function& function, const char* name) {
  function = reinterpret_cast<Function>(egl.get_proc_address(name));
  if (!function) refuse(std::string("OpenGL has no ") + name);
}

}  // namespace

GlContext::GlContext() : context_(make_context(Egl::instance())) {
  const Egl& egl = Egl::instance();
#define MRROC_GL_LOAD(name, type) load(egl, gl_.name, "gl" #name);
  MRROC_GL_FUNCTIONS(MRROC_GL_LOAD)
#undef MRROC_GL_LOAD
}

GlContext::~GlContext() { Egl::instance().destroy_context(Egl::instance().display, context_); }

GlContext::Use::Use(GlContext& context) : context_(context) {
  const Egl& egl = Egl::instance();
  egl.bind_api(EGL_OPENGL_API);  // a property of the thread
  if (!egl.make_current(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context_.context_))
    refuse("the context of OpenGL cannot be used in this thread");
}

GlContext::Use::~Use() {
  const Egl& egl = Egl::instance();
  egl.make_current(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace mrroc::camera

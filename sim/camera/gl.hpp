// OpenGL 3.3 without a window, display or graphics card: functions are loaded at run time from Mesa's EGL, so
// that a program that draws nothing runs without them.
#pragma once
#include <GL/glcorearb.h>

#include <memory>

namespace mrroc::camera {

// Every function of OpenGL that is used: name without gl, and its type.
#define MRROC_GL_FUNCTIONS(X)                                                \
  X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                   \
  X(AttachShader, PFNGLATTACHSHADERPROC)                                     \
  X(BindBuffer, PFNGLBINDBUFFERPROC)                                         \
  X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                               \
  X(BindRenderbuffer, PFNGLBINDRENDERBUFFERPROC)                             \
  X(BindTexture, PFNGLBINDTEXTUREPROC)                                       \
  X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                               \
  X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                               \
  X(BufferData, PFNGLBUFFERDATAPROC)                                         \
  X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                 \
  X(Clear, PFNGLCLEARPROC)                                                   \
  X(ClearColor, PFNGLCLEARCOLORPROC)                                         \
  X(CompileShader, PFNGLCOMPILESHADERPROC)                                   \
  X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                   \
  X(CreateShader, PFNGLCREATESHADERPROC)                                     \
  X(DeleteShader, PFNGLDELETESHADERPROC)                                     \
  X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                 \
  X(Disable, PFNGLDISABLEPROC)                                               \
  X(DrawBuffer, PFNGLDRAWBUFFERPROC)                                         \
  X(DrawElements, PFNGLDRAWELEMENTSPROC)                                     \
  X(Enable, PFNGLENABLEPROC)                                                 \
  X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)               \
  X(FramebufferRenderbuffer, PFNGLFRAMEBUFFERRENDERBUFFERPROC)               \
  X(FramebufferTexture2D, PFNGLFRAMEBUFFERTEXTURE2DPROC)                     \
  X(FrontFace, PFNGLFRONTFACEPROC)                                           \
  X(GenBuffers, PFNGLGENBUFFERSPROC)                                         \
  X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                               \
  X(GenRenderbuffers, PFNGLGENRENDERBUFFERSPROC)                             \
  X(GenTextures, PFNGLGENTEXTURESPROC)                                       \
  X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                               \
  X(GenerateMipmap, PFNGLGENERATEMIPMAPPROC)                                 \
  X(GetError, PFNGLGETERRORPROC)                                             \
  X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                           \
  X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                     \
  X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)                             \
  X(GetShaderiv, PFNGLGETSHADERIVPROC)                                       \
  X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                         \
  X(LinkProgram, PFNGLLINKPROGRAMPROC)                                       \
  X(PixelStorei, PFNGLPIXELSTOREIPROC)                                       \
  X(PolygonOffset, PFNGLPOLYGONOFFSETPROC)                                   \
  X(ReadBuffer, PFNGLREADBUFFERPROC)                                         \
  X(ReadPixels, PFNGLREADPIXELSPROC)                                         \
  X(RenderbufferStorageMultisample, PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC) \
  X(ShaderSource, PFNGLSHADERSOURCEPROC)                                     \
  X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                         \
  X(TexParameterf, PFNGLTEXPARAMETERFPROC)                                   \
  X(TexParameterfv, PFNGLTEXPARAMETERFVPROC)                                 \
  X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                   \
  X(Uniform1f, PFNGLUNIFORM1FPROC)                                           \
  X(Uniform1i, PFNGLUNIFORM1IPROC)                                           \
  X(Uniform3f, PFNGLUNIFORM3FPROC)                                           \
  X(UniformMatrix3fv, PFNGLUNIFORMMATRIX3FVPROC)                             \
  X(UniformMatrix4fv, PFNGLUNIFORMMATRIX4FVPROC)                             \
  X(UseProgram, PFNGLUSEPROGRAMPROC)                                         \
  X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                       \
  X(Viewport, PFNGLVIEWPORTPROC)

/// The functions, without their prefix gl.
struct Gl {
#define MRROC_GL_MEMBER(name, type) type name{};
  MRROC_GL_FUNCTIONS(MRROC_GL_MEMBER)
#undef MRROC_GL_MEMBER
};

/// A context of OpenGL of its own, in memory only. Moves between threads, used by one at a time.
class GlContext {
 public:
  /// @throws FaultError no_renderer  Mesa's libraries are not there or give no such context
  GlContext();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// @return OpenGL's functions; only for a thread whose own the context is
  [[nodiscard]] const Gl& gl() const { return gl_; }

  /// Makes a context the calling thread's own for as long as this lives.
  class Use {
   public:
    /// @param context  must outlive this
    explicit Use(GlContext& context);
    ~Use();
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

   private:
    GlContext& context_;
  };

 private:
  void* context_{};
  Gl gl_;
};

}  // namespace mrroc::camera

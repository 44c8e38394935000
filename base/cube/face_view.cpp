#include "base/cube/face_view.hpp"

namespace mrroc::cube {
namespace {

constexpr int kEdge = 3;  // stickers along it

}  // namespace

Matrix3 facelet_frame(Face face) {
  const Vector3 right = Vector3::UnitX();
  const Vector3 back = Vector3::UnitY();
  const Vector3 above = Vector3::UnitZ();
  Vector3 x = right;
  Vector3 y = above;
  switch (face) {
    case Face::U:
      y = back;
      break;
    case Face::D:
      y = -back;
      break;
    case Face::F:
      break;
    case Face::B:
      x = -right;
      break;
    case Face::R:
      x = back;
      break;
    case Face::L:
      x = -back;
      break;
  }
  Matrix3 R;
  R << x, y, x.cross(y);
  return R;
}

ShownFace shown_face(const Matrix3& R_GC) {
  ShownFace best;
  double most = -4;
  for (int f = 0; f < kFaces; ++f) {
    Matrix3 R = R_GC * facelet_frame(static_cast<Face>(f));  // of the facelets in G
    for (int quarters = 0; quarters < 4; ++quarters) {
      // 1 + 2 cos of the angle that is left when so many quarter turns have been taken back.
      if (R.trace() > most) {
        most = R.trace();
        best = {static_cast<Face>(f), quarters};
      }
      const Vector3 x = R.col(0);
      R.col(0) = R.col(1);
      R.col(1) = -x;
    }
  }
  return best;
}

int facelet(ShownFace shown, int sticker) {
  int row = sticker / kEdge;
  int column = sticker % kEdge;
  for (int k = 0; k < shown.quarters; ++k) {  // back, against the clock
    const int turned = kEdge - 1 - column;
    column = row;
    row = turned;
  }
  return kStickers * number(shown.face) + kEdge * row + column;
}

FaceView view_of(const Matrix3& R_GC, const CubeFaceReading& reading) {
  FaceView view{shown_face(R_GC), reading.stickers};
  if (!reading.seen)
    for (StickerReading& s : view.stickers) s.flaw = StickerFlaw::hidden;
  return view;
}

}  // namespace mrroc::cube

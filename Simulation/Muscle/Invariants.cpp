// SPDX-License-Identifier: Apache-2.0
#include "Muscle/Invariants.h"

#include <cmath>

namespace myotet::muscle {
namespace {

// Adds to the blocks above the diagonal what the second derivative of J is: the block of
// columns j and l of F is the matrix of a cross product with the third one, f.
//     d(f2 x f3)/df2 = -[f3]x,  d(f2 x f3)/df3 = [f2]x,  d(f3 x f1)/df3 = -[f1]x
void add_cross(double factor, const Vec3& f, int j, int l, Tangent& tangent) {
    const Vec3 g = factor * f;
    tangent(3 * j + 1, 3 * l + 0) += g[2];
    tangent(3 * j + 2, 3 * l + 0) -= g[1];
    tangent(3 * j + 0, 3 * l + 1) -= g[2];
    tangent(3 * j + 2, 3 * l + 1) += g[0];
    tangent(3 * j + 0, 3 * l + 2) += g[1];
    tangent(3 * j + 1, 3 * l + 2) -= g[0];
}

}  // namespace

Deformation deform(const Mat3& F, const Vec3& fibre) {
    Deformation at;
    at.F = F;
    at.C.noalias() = F.transpose().lazyProduct(F);
    at.cofactor.col(0) = F.col(1).cross(F.col(2));
    at.cofactor.col(1) = F.col(2).cross(F.col(0));
    at.cofactor.col(2) = F.col(0).cross(F.col(1));
    at.fibre = fibre;
    at.moved.noalias() = F.lazyProduct(fibre);
    at.strained.noalias() = F.transpose().lazyProduct(at.moved);
    at.I.I1 = at.C.trace();
    at.I.I2 = 0.5 * (at.I.I1 * at.I.I1 - at.C.squaredNorm());
    at.I.I4 = at.moved.squaredNorm();
    at.I.I5 = at.strained.squaredNorm();
    at.I.J = F.col(0).dot(at.cofactor.col(0));
    at.I.inverse_cube_root_J = 1 / std::cbrt(at.I.J);
    return at;
}

// dI1/dF = 2 F                        dI2/dF = 2 (I1 F - F C)
// dI4/dF = 2 F a0 (x) a0              dI5/dF = 2 (F a0 (x) C a0 + F C a0 (x) a0)
// dJ/dF  = cof F
Mat3 stress_of(const Deformation& at, const Slopes& w) {
    const Vec3 pulled = w.I4 * at.moved + w.I5 * at.F.lazyProduct(at.strained);
    Mat3 inner = -w.I2 * at.C;
    inner.diagonal().array() += w.I1 + w.I2 * at.I.I1;
    Mat3 P = 2 * at.F.lazyProduct(inner) + w.J * at.cofactor;
    P += 2 * (pulled * at.fibre.transpose() + w.I5 * at.moved * at.strained.transpose());
    return P;
}

// The tangent is made of 3 x 3 blocks, one for each pair of columns j <= l of F; the block
// below the diagonal is the transpose of the one above. Names: f_j the columns of F, a0 the
// fibre, a = F a0, q = C a0, b = F q, B = F F^T, g_m the derivatives above, of which g_m,j is
// a column. Of the second derivatives of the invariants the block (j, l) is
//   I1:  2 d_jl I
//   I2:  2 (2 f_j f_l^T + d_jl (I1 I - B) - C_jl I - f_l f_j^T)
//   I4:  2 a0_j a0_l I
//   I5:  2 ((a0_j q_l + q_j a0_l) I + d_jl a a^T + a0_j a0_l B + a0_l a f_j^T + a0_j f_l a^T)
//   J:   the cross product of add_cross
// W_mn g_m g_n^T with m or n being J are gathered into one vector u: u (x) g_J + g_J (x) u.
Tangent tangent_of(const Deformation& at, const Slopes& w, const Curvatures& c) {
    const Mat3& F = at.F;
    const Vec3 &a = at.moved, &a0 = at.fibre, &q = at.strained;
    const Vec3 b = F.lazyProduct(q);
    const Mat3 B = F.lazyProduct(F.transpose());
    // Halves of g_I2, g_I4 and g_I5; that of g_I1 is F.
    const Mat3 g2 = at.I.I1 * F - F.lazyProduct(at.C);
    const Mat3 g4 = a * a0.transpose();
    const Mat3 g5 = a * q.transpose() + b * a0.transpose();
    const Mat3 u =
        2 * (c.I1_J * F + c.I2_J * g2 + c.I4_J * g4 + c.I5_J * g5) + 0.5 * c.J_J * at.cofactor;
    // What stands to the right of f_j, of a a0_j + ... in the sum over I1, I4 and I5; the
    // 4 f_j f_l^T of I2 goes with it.
    const Mat3 v1 = 4 * ((c.I1_I1 + w.I2) * F + c.I1_I4 * g4 + c.I1_I5 * g5);
    const Mat3 v4 = 4 * (c.I1_I4 * F + c.I4_I4 * g4 + c.I4_I5 * g5);
    const Mat3 v5 = 4 * (c.I1_I5 * F + c.I4_I5 * g4 + c.I5_I5 * g5);
    const Mat3 own = 2 * (w.I5 * (a * a.transpose()) - w.I2 * B);
    Tangent tangent;
    for (int l = 0; l < 3; ++l)
        for (int j = 0; j <= l; ++j) {
            const double fibres = a0[j] * a0[l];
            double one =
                2 * (w.I4 * fibres + w.I5 * (a0[j] * q[l] + q[j] * a0[l]) - w.I2 * at.C(j, l));
            if (j == l) one += 2 * (w.I1 + w.I2 * at.I.I1);
            const Vec3 beside_a =
                a0[j] * v4.col(l) + q[j] * v5.col(l) + 2 * w.I5 * a0[l] * F.col(j);
            const Vec3 beside_b = a0[j] * v5.col(l);
            const Vec3 beside_f = 2 * (w.I5 * a0[j] * a - w.I2 * F.col(j));
            for (int k = 0; k < 3; ++k) {
                Vec3 column = F.col(j) * v1(k, l) + a * beside_a[k] + b * beside_b[k] +
                              F.col(l) * beside_f[k] + u.col(j) * at.cofactor(k, l) +
                              at.cofactor.col(j) * u(k, l) + (2 * w.I5 * fibres) * B.col(k);
                column[k] += one;
                if (j == l) column += own.col(k);
                tangent.block<3, 1>(3 * j, 3 * l + k) = column;
            }
        }
    add_cross(-w.J, F.col(2), 0, 1, tangent);
    add_cross(w.J, F.col(1), 0, 2, tangent);
    add_cross(-w.J, F.col(0), 1, 2, tangent);
    for (int column = 0; column < 9; ++column)
        for (int row = column + 1; row < 9; ++row) tangent(row, column) = tangent(column, row);
    return tangent;
}

}  // namespace myotet::muscle

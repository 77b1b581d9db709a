! SPDX-License-Identifier: BSL-1.0
! Von Mises' plasticity with linear isotropic hardening, by radial return (J. C. Simo, T. J. R. Hughes, Computational
! Inelasticity, 1998, box 3.1), for NTENS of 4 and 6.
! PROPS: shear modulus, bulk modulus, yield stress, hardening modulus [Pa]; a yield stress of zero is none: linear elastic.
! STATEV(1): equivalent plastic strain. STATEV(2): number of calls that ended with this state.
      SUBROUTINE UMAT(STRESS, STATEV, DDSDDE, SSE, SPD, SCD, RPL,
     1 DDSDDT, DRPLDE, DRPLDT, STRAN, DSTRAN, TIME, DTIME, TEMP, DTEMP,
     2 PREDEF, DPRED, CMNAME, NDI, NSHR, NTENS, NSTATV, PROPS, NPROPS,
     3 COORDS, DROT, PNEWDT, CELENT, DFGRD0, DFGRD1, NOEL, NPT, LAYER,
     4 KSPT, KSTEP, KINC)
      IMPLICIT DOUBLE PRECISION (A-H, O-Z)
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS), STATEV(NSTATV), DDSDDE(NTENS, NTENS),
     1 DDSDDT(NTENS), DRPLDE(NTENS), STRAN(NTENS), DSTRAN(NTENS),
     2 TIME(2), PREDEF(1), DPRED(1), PROPS(NPROPS), COORDS(3),
     3 DROT(3, 3), DFGRD0(3, 3), DFGRD1(3, 3), KSTEP(4)
      DIMENSION DEV(6), FLOW(6)
      G = PROPS(1)
      BULK = PROPS(2)
      YIELD = PROPS(3)
      HARD = PROPS(4)
      VOLUME = DSTRAN(1) + DSTRAN(2) + DSTRAN(3)
      DO 10 I = 1, NTENS
        IF (I .LE. NDI) THEN
          STRESS(I) = STRESS(I) + 2D0 * G * (DSTRAN(I) - VOLUME / 3D0)
     1      + BULK * VOLUME
        ELSE
          STRESS(I) = STRESS(I) + G * DSTRAN(I)
        END IF
   10 CONTINUE
      P = (STRESS(1) + STRESS(2) + STRESS(3)) / 3D0
      SIZE = 0D0
      DO 20 I = 1, NTENS
        DEV(I) = STRESS(I)
        IF (I .LE. NDI) DEV(I) = DEV(I) - P
        SIZE = SIZE + DEV(I) * DEV(I) * MERGE(1D0, 2D0, I .LE. NDI)
   20 CONTINUE
      SIZE = SQRT(SIZE)
      RADIUS = SQRT(2D0 / 3D0) * (YIELD + HARD * STATEV(1))
      THETA = 1D0
      THETAB = 0D0
      DO 30 I = 1, NTENS
        FLOW(I) = 0D0
        IF (SIZE .GT. 0D0) FLOW(I) = DEV(I) / SIZE
   30 CONTINUE
      IF (YIELD .GT. 0D0 .AND. SIZE .GT. RADIUS) THEN
        DGAMMA = (SIZE - RADIUS) / (2D0 * G + 2D0 * HARD / 3D0)
        STATEV(1) = STATEV(1) + SQRT(2D0 / 3D0) * DGAMMA
        DO 40 I = 1, NTENS
          STRESS(I) = STRESS(I) - 2D0 * G * DGAMMA * FLOW(I)
   40   CONTINUE
        THETA = 1D0 - 2D0 * G * DGAMMA / SIZE
        THETAB = 1D0 / (1D0 + HARD / (3D0 * G)) - (1D0 - THETA)
      END IF
      DO 60 I = 1, NTENS
        DO 50 J = 1, NTENS
          DDSDDE(I, J) = -2D0 * G * THETAB * FLOW(I) * FLOW(J)
          IF (I .LE. NDI .AND. J .LE. NDI) DDSDDE(I, J) =
     1      DDSDDE(I, J) + BULK - 2D0 * G * THETA / 3D0
   50   CONTINUE
        DDSDDE(I, I) = DDSDDE(I, I)
     1    + G * THETA * MERGE(2D0, 1D0, I .LE. NDI)
   60 CONTINUE
      STATEV(2) = STATEV(2) + 1D0
      RETURN
      END

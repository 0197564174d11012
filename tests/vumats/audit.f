c     SPDX-License-Identifier: BSD-3-Clause
c     Elastic, and checks what the host gives it. PROPS: Young's modulus
c     (Pa), Poisson's ratio, initial density (kg/m3).
c     STATEV(1): sum of the codes below of what was ever wrong, also
c     told by xplb_abqerr; (2) increments; (3) last totalTime; (4) last
c     internal energy; (5) to (13) last F; (14) largest departure of a
c     strain increment from that of F, over the cube of its size.
c       1  U U = F^T F, U symmetric and det U = det F > 0, both ends
c       2  strainInc against F (tensor shear, corotational axes)
c       4  relSpinInc against F and R
c       8  density against det F, in the middle of the increment
c      16  times and dt
c      32  F at the start is F at the end of the increment before
c      64  energy at the start is that returned before
c     128  name in upper case, characteristic length
c     256  data check: not first, or state of a data check was kept
c     A data check is looked at for 1, 2 and 4.
      subroutine vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     1  jInfoArray, stepTime, totalTime, dtArray, cmname, coordMp,
     2  charLength, props, density, strainInc, relSpinInc, tempOld,
     3  stretchOld, defgradOld, fieldOld, stressOld, stateOld,
     4  enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew,
     5  fieldNew, stressNew, stateNew, enerInternNew, enerInelasNew)
      include 'vaba_param.inc'
      character*80 cmname
      dimension props(nprops), density(nblock), coordMp(nblock,*),
     1  charLength(nblock), strainInc(nblock,ndir+nshr),
     2  relSpinInc(nblock,nshr), tempOld(nblock), tempNew(nblock),
     3  stretchOld(nblock,ndir+nshr), stretchNew(nblock,ndir+nshr),
     4  defgradOld(nblock,ndir+nshr+nshr),
     5  defgradNew(nblock,ndir+nshr+nshr),
     6  fieldOld(nblock,nfieldv), fieldNew(nblock,nfieldv),
     7  stressOld(nblock,ndir+nshr), stressNew(nblock,ndir+nshr),
     8  stateOld(nblock,nstatev), stateNew(nblock,nstatev),
     9  enerInternOld(nblock), enerInternNew(nblock),
     1  enerInelasOld(nblock), enerInelasNew(nblock),
     2  jInfoArray(*), dtArray(*)
      dimension fo(3,3), fn(3,3), uo(3,3), un(3,3), ro(3,3), rn(3,3),
     1  vg(3,3), d(3,3), w(3,3), e(3,3), t(3,3), ra(3,3), om(3,3),
     2  last(9), intv(1), realv(1)
      real*8 last
      character*8 charv(1)
      logical asked, check
      save asked
      data asked /.false./
c
      ncom = ndir + nshr
      call hooke(nblock, ncom, props(1), props(2), density, strainInc,
     1  stressOld, enerInternOld, stressNew, enerInternNew)
      check = stepTime .eq. 0 .and. totalTime .eq. 0
      if (check) asked = .true.
      dt = dtArray(1)
      do k = 1, nblock
        icode = 0
        call tensor(nblock, nshr, k, defgradOld, .false., fo)
        call tensor(nblock, nshr, k, defgradNew, .false., fn)
        call tensor(nblock, nshr, k, stretchOld, .true., uo)
        call tensor(nblock, nshr, k, stretchNew, .true., un)
        call tensor(nblock, nshr, k, strainInc, .true., e)
c       Right stretch.
        tight = 1d-12
        if (wrong(matmul(uo, uo), matmul(transpose(fo), fo), tight) .or.
     1    wrong(matmul(un, un), matmul(transpose(fn), fn), tight) .or.
     2    det(uo) .le. 0 .or. det(un) .le. 0 .or.
     3    abs(det(un)/det(fn) - 1) .gt. 1d-9) icode = icode + 1
c       Rotations of both ends; velocity gradient of the middle.
        call invert(uo, t)
        ro = matmul(fo, t)
        call invert(un, t)
        rn = matmul(fn, t)
        call invert((fo + fn)/2, t)
        vg = matmul(fn - fo, t)
        d = (vg + transpose(vg))/2
        w = (vg - transpose(vg))/2
        size = sqrt(sum(vg**2))
        allowed = size**3 + 1d-13*(1 + sqrt(sum(fn**2)))
        t = (matmul(transpose(ro), matmul(d, ro))
     1    + matmul(transpose(rn), matmul(d, rn)))/2
        error = sqrt(sum((t - e)**2))
        if (.not. (error .le. allowed)) icode = icode + 2
        if (size .gt. 1d-4 .and. .not. check)
     1    stateNew(k,14) = max(stateOld(k,14), error/size**3)
c       Spin less the rotation of the frame, in corotational axes.
        ra = matmul(rn, transpose(ro))
        om = (ra - transpose(ra))/2
        t = (matmul(transpose(ro), matmul(w - om, ro))
     1    + matmul(transpose(rn), matmul(w - om, rn)))/2
        error = 0
        if (nshr .eq. 1) error = abs(t(2,1) - relSpinInc(k,1))
        if (nshr .eq. 3) error = abs(t(3,2) - relSpinInc(k,1))
     1    + abs(t(1,3) - relSpinInc(k,2))
     2    + abs(t(2,1) - relSpinInc(k,3))
        if (.not. (error .le. 3*allowed)) icode = icode + 4
        if (check) go to 10
c       Mass.
        error = density(k)*sqrt(det(fo)*det(fn))/props(3) - 1
        if (.not. (abs(error) .le. 1d-8)) icode = icode + 8
c       Times at the end of the increment.
        error = totalTime - stateOld(k,3) - dt
        if (.not. (dt .gt. 0 .and. stepTime .gt. 0 .and.
     1    stepTime .le. totalTime .and.
     2    abs(error) .le. 1d-6*dt + 1d-12)) icode = icode + 16
c       What was given back comes again.
        do j = 1, ncom + nshr
          last(j) = defgradNew(k,j)
          if (stateOld(k,2) .gt. 0 .and.
     1      defgradOld(k,j) .ne. stateOld(k,4+j)) icode = ior(icode, 32)
        end do
        if (stateOld(k,2) .gt. 0 .and.
     1    enerInternOld(k) .ne. stateOld(k,4)) icode = icode + 64
        if (cmname(1:5) .ne. 'AUDIT' .or. cmname(80:80) .ne. ' ' .or.
     1    .not. (charLength(k) .gt. 0)) icode = icode + 128
        if (.not. asked .or. stateOld(k,2) .lt. 0) icode = icode + 256
c
  10    stateNew(k,1) = ior(int(stateOld(k,1)), icode)
        stateNew(k,2) = stateOld(k,2) + 1
        stateNew(k,3) = totalTime
        stateNew(k,4) = enerInternNew(k)
        do j = 1, ncom + nshr
          stateNew(k,4+j) = last(j)
        end do
        if (icode .ne. 0) then
          intv(1) = icode
          realv(1) = totalTime
          charv(1) = cmname(1:8)
          call xplb_abqerr(-1, 'audit of %S: code %I at %R s', intv,
     1      realv, charv)
        end if
      end do
c     Of no consequence, or the next call finds it.
      if (check) then
        stateNew = -777
        enerInternNew = -777
      end if

      contains

c     Symmetric or general tensor of point k.
      subroutine tensor(n, nshear, k, a, symmetric, t)
      integer n, nshear, k, j
      real*8 a(n,*), t(3,3)
      logical symmetric
      t = 0
      do j = 1, 3
        t(j,j) = a(k,j)
      end do
      do j = 1, nshear
        t(j,mod(j,3)+1) = a(k,3+j)
        if (symmetric) t(mod(j,3)+1,j) = a(k,3+j)
        if (.not. symmetric) t(mod(j,3)+1,j) = a(k,3+nshear+j)
      end do
      end subroutine

      logical function wrong(a, b, tolerance)
      real*8 a(3,3), b(3,3), tolerance
      wrong = .not. (maxval(abs(a - b)) .le. tolerance*maxval(abs(b)))
      end function

      real*8 function det(a)
      real*8 a(3,3)
      det = a(1,1)*(a(2,2)*a(3,3) - a(2,3)*a(3,2))
     1  - a(1,2)*(a(2,1)*a(3,3) - a(2,3)*a(3,1))
     2  + a(1,3)*(a(2,1)*a(3,2) - a(2,2)*a(3,1))
      end function

      subroutine invert(a, b)
      real*8 a(3,3), b(3,3)
      integer i, j
      do i = 1, 3
        do j = 1, 3
          b(j,i) = a(mod(i,3)+1,mod(j,3)+1)*a(mod(i+1,3)+1,mod(j+1,3)+1)
     1      - a(mod(i,3)+1,mod(j+1,3)+1)*a(mod(i+1,3)+1,mod(j,3)+1)
        end do
      end do
      b = b/det(a)
      end subroutine
      end

c     stressOld + lambda tr(strain) 1 + 2 G strain, and its energy.
      subroutine hooke(nblock, ncom, young, poisson, density,
     1  strainInc, stressOld, enerOld, stressNew, enerNew)
      include 'vaba_param.inc'
      dimension density(nblock), strainInc(nblock,ncom),
     1  stressOld(nblock,ncom), enerOld(nblock),
     2  stressNew(nblock,ncom), enerNew(nblock)
      twog = young/(1 + poisson)
      alam = twog*poisson/(1 - 2*poisson)
      do k = 1, nblock
        volume = strainInc(k,1) + strainInc(k,2) + strainInc(k,3)
        work = 0
        do i = 1, ncom
          stressNew(k,i) = stressOld(k,i) + twog*strainInc(k,i)
          if (i .le. 3) stressNew(k,i) = stressNew(k,i) + alam*volume
          part = (stressOld(k,i) + stressNew(k,i))*strainInc(k,i)/2
          if (i .gt. 3) part = 2*part
          work = work + part
        end do
        enerNew(k) = enerOld(k) + work/density(k)
      end do
      end

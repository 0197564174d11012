c     SPDX-License-Identifier: BSD-3-Clause
c     Linear isotropic elasticity. PROPS: Young's modulus (Pa),
c     Poisson's ratio, and 1 for the rate of Jaumann in place of that of
c     Green and Naghdi: old stress is then turned by relSpinInc, half of
c     it before and half of it after the strain.
c     STATEV(1) counts the increments.
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
      dimension turned(nblock,6), after(nblock,6)
c
      ncom = ndir + nshr
      half = 0
      if (nprops .ge. 3) half = props(3)/2
      call turn(nblock, nshr, half, relSpinInc, stressOld, turned)
      call hooke(nblock, ncom, props(1), props(2), density, strainInc,
     1  turned, enerInternOld, after, enerInternNew)
      call turn(nblock, nshr, half, relSpinInc, after, stressNew)
      do k = 1, nblock
        stateNew(k,1) = stateOld(k,1)
        if (totalTime .gt. 0) stateNew(k,1) = stateOld(k,1) + 1
      end do
      end

c     to = Q from Q^T, Q the rotation by part*spin (Cayley's form, which
c     is a rotation for spins of any size).
      subroutine turn(nblock, nshr, part, spin, from, to)
      include 'vaba_param.inc'
      dimension spin(nblock,nshr), from(nblock,3+nshr),
     1  to(nblock,3+nshr), w(3), q(3,3), s(3,3), x(3,3), one(3,3)
      one = 0
      do i = 1, 3
        one(i,i) = 1
      end do
      do k = 1, nblock
        w = 0
        if (nshr .eq. 1) w(3) = part*spin(k,1)
        if (nshr .eq. 3) w = part*spin(k,:)
        x = 0
        x(3,2) = w(1)
        x(1,3) = w(2)
        x(2,1) = w(3)
        x = (x - transpose(x))/2
        q = one + 2/(1 + sum(w**2)/4)*(x + matmul(x, x))
        s = 0
        do i = 1, 3
          s(i,i) = from(k,i)
        end do
        do j = 1, nshr
          s(j,mod(j,3)+1) = from(k,3+j)
          s(mod(j,3)+1,j) = from(k,3+j)
        end do
        s = matmul(q, matmul(s, transpose(q)))
        do i = 1, 3
          to(k,i) = s(i,i)
        end do
        do j = 1, nshr
          to(k,3+j) = s(j,mod(j,3)+1)
        end do
      end do
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

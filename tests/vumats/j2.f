c     SPDX-License-Identifier: BSD-3-Clause
c     Plasticity of von Mises with linear isotropic hardening, radial
c     return. PROPS: Young's modulus (Pa), Poisson's ratio, yield stress
c     (Pa), hardening modulus (Pa).
c     STATEV: equivalent plastic strain, yield stress (0: the initial).
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
      dimension trial(nblock,6), ener(nblock)
c
      ncom = ndir + nshr
      call hooke(nblock, ncom, props(1), props(2), density, strainInc,
     1  stressOld, enerInternOld, trial, ener)
      shear = props(1)/(2*(1 + props(2)))
      do k = 1, nblock
        yield = stateOld(k,2)
        if (yield .eq. 0) yield = props(3)
        p = (trial(k,1) + trial(k,2) + trial(k,3))/3
        square = 0
        do i = 1, ncom
          s = trial(k,i)
          if (i .le. 3) s = s - p
          if (i .le. 3) square = square + s*s
          if (i .gt. 3) square = square + 2*s*s
        end do
        q = sqrt(1.5d0*square)
        gain = 0
c       The data check asks for the elastic answer.
        if (totalTime .gt. 0 .and. q .gt. yield)
     1    gain = (q - yield)/(3*shear + props(4))
        factor = 1
        if (gain .gt. 0) factor = 1 - 3*shear*gain/q
        work = 0
        do i = 1, ncom
          s = trial(k,i)
          if (i .le. 3) stressNew(k,i) = p + factor*(s - p)
          if (i .gt. 3) stressNew(k,i) = factor*s
          part = (stressOld(k,i) + stressNew(k,i))*strainInc(k,i)/2
          if (i .gt. 3) part = 2*part
          work = work + part
        end do
        stateNew(k,1) = stateOld(k,1) + gain
        stateNew(k,2) = yield + props(4)*gain
        enerInternNew(k) = enerInternOld(k) + work/density(k)
        enerInelasNew(k) = enerInelasOld(k)
     1    + gain*(yield + stateNew(k,2))/2/density(k)
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

c     SPDX-License-Identifier: BSD-3-Clause
c     A Fortran caller of the material with the argument list of
c     ABAQUS/Explicit: blocks of 136 points, in plane and in space.
c     The include file decides the precision, as in users' files.
      program fortran_caller
      include 'vaba_param.inc'
      write (*,'(a,i2)') 'bytes of a real: ', kind(1.0)*j_sys_Dimension
      call check_block(1)
      call check_block(3)
      write (*,'(a)') 'all correct'
      end

c     One shape: data check, 50 increments, annealing.
      subroutine check_block(nshr)
      include 'vaba_param.inc'
      parameter (nblock = maxblk, ndir = 3, nstatev = 6, nfieldv = 1)
      parameter (nprops = 14, maxcom = 6, nsteps = 50)
      parameter (p_at = 101325., e_start = 0.58d0)
      character*80 cmname
      external vumat
      dimension jInfoArray(8+nblock), dtArray(2*nblock+1)
      dimension props(nprops), density(nblock), coordMp(nblock,3),
     1  charLength(nblock), strainInc(nblock*maxcom),
     2  relSpinInc(nblock*3), tempOld(nblock), tempNew(nblock),
     3  stretchOld(nblock*maxcom), stretchNew(nblock*maxcom),
     4  defgradOld(nblock*9), defgradNew(nblock*9),
     5  fieldOld(nblock,nfieldv), fieldNew(nblock,nfieldv),
     6  stressOld(nblock*maxcom), stressNew(nblock*maxcom),
     7  stateOld(nblock,nstatev), stateNew(nblock,nstatev),
     8  enerInternOld(nblock), enerInternNew(nblock),
     9  enerInelasOld(nblock), enerInelasNew(nblock)
      data props /100., 0.2d0, 0.51d0, 18.5d0, 0.76d0, 0.04d0, 0.3d0,
     1  1., 0.0015d0, 3.3d0, 1., e_start, p_at, 0./
c
      eps = epsilon(props(1))
      ncom = ndir + nshr
      cmname = 'SIMSAND-1'
      jInfoArray = -7
      dtArray = -7
      jInfoArray(1) = 0
      dtArray(1) = 1d-5
      density = 1600
      coordMp = 0
      charLength = 0.002
      relSpinInc = 0
      tempOld = 0
      tempNew = 0
      stretchOld = 1
      stretchNew = 1
      defgradOld = 1
      defgradNew = 1
      fieldOld = 0
      fieldNew = 0
      stateOld = 0
      stateOld(:,nstatev) = 42
      enerInternOld = 0
      enerInelasOld = 0
      stressOld = 0
c     Points k and k + nblock/2 are twins.
      do k = 1, nblock
        twin = mod(k - 1, nblock/2) + 1
        do i = 1, 3
          stressOld((i-1)*nblock + k) = -100*twin
        end do
        do i = 1, ncom
          strainInc((i-1)*nblock + k) = 1d-5*sin(7.*i + 3.*twin)
        end do
      end do
c
c     Data check: isotropic and elastic with the state in place.
      stressNew = -1
      stateNew = -1
      stepTime = 0
      totalTime = 0
      call vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     1  jInfoArray, stepTime, totalTime, dtArray, cmname, coordMp,
     2  charLength, props, density, strainInc, relSpinInc, tempOld,
     3  stretchOld, defgradOld, fieldOld, stressOld, stateOld,
     4  enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew,
     5  fieldNew, stressNew, stateNew, enerInternNew, enerInelasNew)
      worst = 0
      do k = 1, nblock
        p = -stressOld(k)
        bulk = 100*p_at*(2.97d0 - e_start)**2/(1 + e_start)
     1    *(p/p_at)**props(3)
        shear = 0.75*bulk
        volume = strainInc(k) + strainInc(nblock+k)
     1    + strainInc(2*nblock+k)
        do i = 1, ncom
          j = (i-1)*nblock + k
          expected = stressOld(j) + 2*shear*strainInc(j)
          if (i .le. 3) expected = expected
     1      + (bulk - 2*shear/3)*volume
          worst = max(worst, abs(stressNew(j) - expected)/p)
        end do
      end do
      write (*,'(a,i1,a,es8.1)') 'nshr ', nshr,
     1  ': data check against the moduli, relative ', worst
      call require(worst .lt. 1000*eps, 'data check')
c
c     Increments.
      worst_void = 0
      worst_energy = 0
      yielded = 0
      do n = 1, nsteps
        stepTime = n*dtArray(1)
        totalTime = stepTime
        stressNew = -1
        stateNew = -1
        enerInternNew = -1
        enerInelasNew = -1
        call vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     1    jInfoArray, stepTime, totalTime, dtArray, cmname, coordMp,
     2    charLength, props, density, strainInc, relSpinInc, tempOld,
     3    stretchOld, defgradOld, fieldOld, stressOld, stateOld,
     4    enerInternOld, enerInelasOld, tempNew, stretchNew,
     5    defgradNew, fieldNew, stressNew, stateNew, enerInternNew,
     6    enerInelasNew)
        do k = 1, nblock
          volume = strainInc(k) + strainInc(nblock+k)
     1      + strainInc(2*nblock+k)
          e = stateOld(k,1)
          if (e .eq. 0) e = e_start
          worst_void = max(worst_void,
     1      abs(stateNew(k,1) - ((1 + e)*exp(volume) - 1)))
          work = 0
          scale = 0
          do i = 1, ncom
            j = (i-1)*nblock + k
            part = (stressOld(j) + stressNew(j))*strainInc(j)/2
            if (i .gt. 3) part = 2*part
            work = work + part
            scale = scale + abs(part)
          end do
          gain = (enerInternNew(k) - enerInternOld(k))*density(k)
          scale = scale + abs(enerInternNew(k))*density(k)
          worst_energy = max(worst_energy, abs(gain - work)/scale)
          call require(stateNew(k,4) .ge. 0, 'status')
          if (stateNew(k,4) .gt. 0) yielded = yielded + 1
          call require(stateNew(k,2) .ge. 0, 'hardening variable')
          call require(stateNew(k,nstatev) .eq. 42,
     1      'a state variable beyond its own')
          call require(enerInelasNew(k) .ge. enerInelasOld(k),
     1      'dissipation')
        end do
        do i = 1, ncom
          do k = 1, nblock/2
            j = (i-1)*nblock + k
            call require(stressNew(j) .eq. stressNew(j + nblock/2),
     1        'twins')
          end do
        end do
        call require(all(stressNew(ncom*nblock+1:) .eq. -1),
     1    'nothing beyond the last component')
        stressOld = stressNew
        stateOld = stateNew
        enerInternOld = enerInternNew
        enerInelasOld = enerInelasNew
      end do
      write (*,'(a,i1,a,es8.1,a,es8.1,a,f6.1,a)') 'nshr ', nshr,
     1  ': void ratio ', worst_void, ', energy ', worst_energy,
     2  ', yielding ', 100*yielded/(nblock*nsteps), ' % of updates'
      call require(worst_void .lt. 8*eps, 'void ratio')
      call require(worst_energy .lt. 100*eps, 'energy per mass')
      call require(yielded .gt. 0, 'no point ever yielded')
      call require(jInfoArray(1) .eq. 0 .and.
     1  all(jInfoArray(2:) .eq. -7), 'argument 7')
      call require(all(dtArray(2:) .eq. -7), 'argument 10')
      call require(cmname .eq. 'SIMSAND-1', 'cmname')
c
c     Annealing forgets the hardening variable and keeps the stress.
      jInfoArray(1) = 1
      call vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops,
     1  jInfoArray, stepTime, totalTime, dtArray, cmname, coordMp,
     2  charLength, props, density, strainInc, relSpinInc, tempOld,
     3  stretchOld, defgradOld, fieldOld, stressOld, stateOld,
     4  enerInternOld, enerInelasOld, tempNew, stretchNew, defgradNew,
     5  fieldNew, stressNew, stateNew, enerInternNew, enerInelasNew)
      call require(all(stateNew(:,4) .eq. 0), 'status of annealing')
      call require(all(stateNew(:,1) .eq. stateOld(:,1)),
     1  'void ratio of annealing')
      call require(all(stressNew .eq. stressOld),
     1  'stress of annealing')
      end

      subroutine require(fulfilled, what)
      logical fulfilled
      character*(*) what
      if (.not. fulfilled) then
        write (*,'(2a)') 'wrong: ', what
        stop 1
      end if
      end

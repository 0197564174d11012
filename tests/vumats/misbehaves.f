c     SPDX-License-Identifier: BSD-3-Clause
c     Elastic, and breaks one rule. PROPS: which one, from which
c     totalTime on (s; negative: in the data check already), Young's
c     modulus (Pa), Poisson's ratio. STATEV(1) counts the increments.
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
      dimension intv(2), realv(2), work(1024,6)
      character*8 charv(2)
      character*256 jobname, outdir
      integer, volatile, save :: inside = 0
      save work
      interface
        subroutine usleep(microseconds) bind(c)
          use iso_c_binding
          integer(c_int), value :: microseconds
        end subroutine
      end interface
c
      n = nblock
      ncom = ndir + nshr
      kind = int(props(1))
      if (totalTime .le. props(2)) kind = 0
      select case (kind)
      case (9)
c       The last point is left without a stress.
        call hooke(n, ncom, props(3), props(4), density, strainInc,
     1    stressOld, enerInternOld, work, enerInternNew)
        do i = 1, ncom
          do k = 1, n - 1
            stressNew(k,i) = work((i-1)*n + k,1)
          end do
        end do
      case (10)
c       State and energies are left unwritten.
        call hooke(n, ncom, props(3), props(4), density, strainInc,
     1    stressOld, enerInternOld, stressNew, work)
        return
      case (16)
c       Scratch of all callers in one place; STATEV(2): met another.
        inside = inside + 1
        if (inside .gt. 1) stateNew(:,2) = 1
        call hooke(n, ncom, props(3), props(4), density, strainInc,
     1    stressOld, enerInternOld, work, enerInternNew)
        call usleep(2000)
        if (inside .gt. 1) stateNew(:,2) = 1
        do i = 1, ncom
          do k = 1, n
            j = (i-1)*n + k
            stressNew(k,i) = work(mod(j-1,1024)+1,(j-1)/1024+1)
          end do
        end do
        inside = inside - 1
      case default
        call hooke(n, ncom, props(3), props(4), density, strainInc,
     1    stressOld, enerInternOld, stressNew, enerInternNew)
      end select
      do k = 1, n
        stateNew(k,1) = stateOld(k,1)
        if (totalTime .gt. 0) stateNew(k,1) = stateOld(k,1) + 1
      end do
c
      select case (kind)
      case (1)
        stateNew(n,nstatev+1) = 1
      case (2)
        do k = 1, n
          stressNew(k,ncom+1) = 0
          stressNew(k,ncom+2) = 0
        end do
      case (3)
        stressNew(0,1) = 0
      case (4)
        strainInc(1,ncom+1) = 0
      case (5)
        strainInc(1,1) = strainInc(1,1) + 1
      case (6)
        stressOld = stressNew
      case (7)
        props(3) = 0
      case (8)
        nblock = 1
        ndir = 0
        nshr = -1
        nstatev = 100
        nprops = 0
        jInfoArray(1) = 1
        stepTime = -1
        totalTime = -1
        dtArray(1) = 1.1d0
        cmname = 'nobody'
      case (11)
        stressNew(n,1) = sqrt(-1 - totalTime)
      case (12)
        call xplb_exit
      case (13)
        intv(1) = 7
        intv(2) = 8
        realv(1) = 2.5d0
        charv(1) = 'sand'
        call xplb_abqerr(1, 'all is %S', intv, realv, charv)
        call xplb_abqerr(-1, '%I of %I at %R', intv, realv, charv)
        call xplb_abqerr(-2, 'no arrays: %I', 0, 0, ' ')
      case (14)
        realv(1) = totalTime
        call xplb_abqerr(-3, 'cannot go on after %R s', 0, realv, ' ')
      case (15)
        stop
      case (17)
        call vgetjobname(jobname, length)
        call vgetoutdir(outdir, lengthd)
        call vgetrank(irank)
        call vgetnumcpus(ncpus)
        intv(1) = irank
        intv(2) = ncpus
        charv(1) = jobname(1:length)
        charv(2) = outdir(lengthd-7:lengthd)
        call xplb_abqerr(1, '%S in %S, %I of %I', intv, realv, charv)
      case (18)
        stressNew(1,1) = stressNew(1,1) + stateOld(n,nstatev+1)
      case (19)
        stateNew(n,nstatev) = sqrt(-1 - totalTime)
      case (20)
        enerInelasNew(n) = sqrt(-1 - totalTime)
      case (21)
        jInfoArray(0) = 0
      case (22)
        jInfoArray(9+n) = 0
      case (23)
c       Element numbers into STATEV; point, layer and section point are 1.
        do k = 1, n
          stateNew(k,1) = jInfoArray(jInfoArray(6)+k-1)
     1      *jInfoArray(2)*jInfoArray(3)*jInfoArray(4)
        end do
      case (24)
        strainInc(1,1) = strainInc(1,1) + 1
        stressNew(n,1) = sqrt(-1 - totalTime)
      end select
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

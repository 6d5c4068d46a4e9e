      subroutine vfric(
c       write only
     &  fTangential,
c       read and write
     &  statev,
c       read only
     &  kStep, kInc, nContact, nFacNod, nSlvNod, nMstNod, nFricDir,
     &  nDir, nStateVar, nProps, nTemp, nPred, numDefTfv,
     &  jSlvUid, jMstUid, jConSlvid, jConMstid, timStep, timGlb,
     &  dTimCur, surfInt, surfSlv, surfMst, lContType, dSlipFric,
     &  fStickForce, fTangPrev, fNormal, frictionWork, shape,
     &  coordSlv, coordMst, dirCosSl, dircosN, props, areaSlv,
     &  tempSlv, preDefSlv, tempMst, preDefMst)
c
      include 'vaba_param.inc'
c
      character*80 surfInt, surfSlv, surfMst
      dimension fTangential(nFricDir,nContact),
     &  statev(nStateVar,nSlvNod), props(nProps),
     &  dSlipFric(nDir,nContact), fTangPrev(nDir,nContact),
     &  fStickForce(nContact), fNormal(nContact),
     &  shape(nFacNod,nContact), areaSlv(nSlvNod),
     &  coordSlv(nDir,nSlvNod), coordMst(nDir,nMstNod),
     &  dirCosSl(nDir,nContact), dircosN(nDir,nContact),
     &  jSlvUid(nSlvNod), jMstUid(nMstNod), jConSlvid(nContact),
     &  jConMstid(nFacNod,nContact), tempSlv(nContact),
     &  preDefSlv(nContact,nPred), tempMst(numDefTfv),
     &  preDefMst(numDefTfv,nPred)
      parameter (zero = 0.d0, half = 0.5d0, one = 1.d0)
c
c     statev(1,n): 1 where slave node n slips, else 0; the nodes that
c     slipped are marked -1 until they are met again or found free
      do 10 n = 1, nSlvNod
         if (statev(1,n) .gt. half) statev(1,n) = -one
   10 continue
      do 50 k = 1, nContact
         do 20 i = 1, nFricDir
            fTangential(i,k) = zero
   20    continue
         n = jConSlvid(k)
         stick = fStickForce(k)
         if (stick .gt. zero .and. fNormal(k) .gt. zero) then
            if (statev(1,n) .gt. -half .and.
     &          stick .le. props(1)*fNormal(k)) then
c              at rest, and stays so
               fTangential(1,k) = -stick
            else
c              slips: contact pressure and slip speed, then the law
               area = areaSlv(n)
               press = zero
               if (area .gt. zero) press = fNormal(k)/area
               slip2 = zero
               do 30 i = 1, nDir
                  slip2 = slip2 + dSlipFric(i,k)**2
   30          continue
               speed = zero
               if (dTimCur .gt. zero) speed = sqrt(slip2)/dTimCur
               rate = zero
               xmass = props(nProps)*area
               if (xmass .gt. zero) rate = dTimCur/xmass
               fTangential(1,k) = -fricsl(nProps, props, press, speed,
     &            fNormal(k), stick, rate)
c              it has come to rest when all of the force was needed
               if (-fTangential(1,k) .lt. stick) then
                  statev(1,n) = one
               else
                  statev(1,n) = zero
               end if
            end if
         end if
   50 continue
      do 60 n = 1, nSlvNod
         if (statev(1,n) .lt. -half) statev(1,n) = zero
   60 continue
c
c     The arguments that no law here needs are named once, out of
c     reach, so that a compiler's warning about one means something.
      if (nContact .lt. 0) then
         unused = timStep + timGlb + frictionWork + shape(1,1)
     &      + fTangPrev(1,1) + coordSlv(1,1)
     &      + coordMst(1,1) + dirCosSl(1,1) + dircosN(1,1)
     &      + tempSlv(1) + preDefSlv(1,1) + tempMst(1)
     &      + preDefMst(1,1)
         iunused = kStep + kInc + nTemp + lContType + jSlvUid(1)
     &      + jMstUid(1) + jConMstid(1,1) + ichar(surfInt(1:1))
     &      + ichar(surfSlv(1:1)) + ichar(surfMst(1:1))
         fTangential(1,1) = unused + dble(iunused)
      end if
      return
      end

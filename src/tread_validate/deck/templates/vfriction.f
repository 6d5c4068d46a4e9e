      subroutine vfriction(
c       write only
     &  fTangential,
c       read and write
     &  state,
c       read only
     &  nBlock, nBlockAnal, nBlockEdge, nNodState, nNodSlv, nNodMst,
     &  nFricDir, nDir, nStates, nProps, nTemp, nFields, jFlags,
     &  rData, surfInt, surfSlv, surfMst, jConSlvUid, jConMstUid,
     &  props, dSlipFric, fStickForce, fTangPrev, fNormal, areaCont,
     &  dircosN, dircosSl, shapeSlv, shapeMst, coordSlv, coordMst,
     &  velSlv, velMst, tempSlv, tempMst, fieldSlv, fieldMst)
c
      include 'vaba_param.inc'
c
c     jFlags: step, increment, type of contact
c     rData: step time, total time, time increment, frictional work
      character*80 surfInt, surfSlv, surfMst
      dimension fTangential(nFricDir,nBlock),
     &  state(nStates,nNodState,nBlock), jFlags(3), rData(4),
     &  jConSlvUid(nNodSlv,nBlock), jConMstUid(nNodMst,nBlockAnal),
     &  props(nProps), dSlipFric(nDir,nBlock), fStickForce(nBlock),
     &  fTangPrev(nDir,nBlock), fNormal(nBlock), areaCont(nBlock),
     &  dircosN(nDir,nBlock), dircosSl(nDir,nBlock),
     &  shapeSlv(nNodSlv,nBlockEdge), shapeMst(nNodMst,nBlockAnal),
     &  coordSlv(nDir,nNodSlv,nBlock),
     &  coordMst(nDir,nNodMst,nBlockAnal),
     &  velSlv(nDir,nNodSlv,nBlock), velMst(nDir,nNodMst,nBlockAnal),
     &  tempSlv(nBlock), tempMst(nBlockAnal),
     &  fieldSlv(nFields,nBlock), fieldMst(nFields,nBlockAnal)
      parameter (zero = 0.d0, half = 0.5d0, one = 1.d0)
c
c     state(1,1,k): 1 where contact point k slips, else 0
c     state(2,1,k): the increment in which it was met last; a point
c     that was free in between is met at rest
      do 30 k = 1, nBlock
         do 10 i = 1, nFricDir
            fTangential(i,k) = zero
   10    continue
         if (jFlags(2) .gt. 1 .and.
     &       abs(state(2,1,k) - dble(jFlags(2) - 1)) .gt. half)
     &       state(1,1,k) = zero
         state(2,1,k) = dble(jFlags(2))
         stick = fStickForce(k)
         if (stick .gt. zero .and. fNormal(k) .gt. zero) then
            if (state(1,1,k) .lt. half .and.
     &          stick .le. props(1)*fNormal(k)) then
c              at rest, and stays so
               fTangential(1,k) = -stick
            else
c              slips: contact pressure and slip speed, then the law
               press = zero
               if (areaCont(k) .gt. zero) press = fNormal(k)/areaCont(k)
               slip2 = zero
               do 20 i = 1, nDir
                  slip2 = slip2 + dSlipFric(i,k)**2
   20          continue
               speed = zero
               if (rData(3) .gt. zero) speed = sqrt(slip2)/rData(3)
               rate = zero
               xmass = props(nProps)*areaCont(k)
               if (xmass .gt. zero) rate = rData(3)/xmass
               fTangential(1,k) = -fricsl(nProps, props, press, speed,
     &            fNormal(k), stick, rate)
c              it has come to rest when all of the force was needed
               state(1,1,k) = zero
               if (-fTangential(1,k) .lt. stick) state(1,1,k) = one
            end if
         else
            state(1,1,k) = zero
         end if
   30 continue
c
c     The arguments that no law here needs are named once, out of
c     reach, so that a compiler's warning about one means something.
      if (nBlock .lt. 0) then
         unused = rData(1) + fTangPrev(1,1)
     &      + dircosN(1,1) + dircosSl(1,1) + shapeSlv(1,1)
     &      + shapeMst(1,1) + coordSlv(1,1,1) + coordMst(1,1,1)
     &      + velSlv(1,1,1) + velMst(1,1,1) + tempSlv(1)
     &      + tempMst(1) + fieldSlv(1,1) + fieldMst(1,1)
         iunused = jFlags(1) + nTemp + jConSlvUid(1,1)
     &      + jConMstUid(1,1) + ichar(surfInt(1:1))
     &      + ichar(surfSlv(1:1)) + ichar(surfMst(1:1))
         fTangential(1,1) = unused + dble(iunused)
      end if
      return
      end

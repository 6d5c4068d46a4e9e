c
c     Friction of a point that slips: F = mu(p, v) N with the speed that
c     F leaves it, v = (stick - F) rate, and stick if that stops it.
c     Fixed-point steps where they gain, else halving. Without a rate
c     the law is taken at the speed given.
c
      function fricsl(nProps, props, press, speed, fn, stick, rate)
      include 'vaba_param.inc'
      dimension props(nProps)
      f = min(fricmu(nProps, props, press, speed)*fn, stick)
      fricsl = f
      if (rate .le. 0.d0) return
      if (fricmu(nProps, props, press, 0.d0)*fn .ge. stick) then
         fricsl = stick
         return
      end if
      below = 0.d0
      above = stick
      before = 2.d0*stick
      do 10 i = 1, 200
         g = fricmu(nProps, props, press, (stick - f)*rate)*fn - f
         if (abs(g) .le. 1.d-11*fn) goto 20
         if (g .gt. 0.d0) then
            below = f
         else
            above = f
         end if
         if (above - below .le. 1.d-14*stick) goto 20
         f = f + g
         if (f .le. below .or. f .ge. above .or.
     &       abs(g) .gt. 0.5d0*before) f = 0.5d0*(below + above)
         before = abs(g)
   10 continue
   20 fricsl = f
      return
      end

c
c     Kinetic friction coefficient after Huemer et al., Eng. Comput.
c     18 (2001) 417-436:
c       mu = (alpha p**(n-1) + beta)
c            / (a + b v**(-1/m) + c v**(-2/m)),  p in MPa, v in m/s
c     props(1)      static coefficient
c     props(2..8)   alpha, beta, n, m, a, b, c
c     props(9)      least contact pressure, MPa
c     props(10)     least slip speed, mm/s
c     The form diverges as p goes to 0 and vanishes as v goes to 0:
c     it is evaluated at no less than props(9) and props(10).
c
      function fricmu(nProps, props, press, speed)
      include 'vaba_param.inc'
      dimension props(nProps)
      p = max(abs(press), props(9))
      v = max(abs(speed), props(10))*1.d-3
      u = v**(-1.d0/props(5))
      above = props(2)*p**(props(4) - 1.d0) + props(3)
      below = props(6) + props(7)*u + props(8)*u*u
      fricmu = above/below
      return
      end
